// The intersection of three slabs (Kay and Kajiya 1986).

struct BoxLine {
    Line line;
};

BoxLine line_of(Box box, Ray ray) {
    return BoxLine(recentred(ray, box.anchor, Real3(0.0)));
}

// `k`: of the box's axes.
Interval slab(Box box, Line line, Real3 axis, Real3 axis_error, uint k) {
    Real offset, slope;
    if (ARE_BOXES_AXIS_ALIGNED) {
        offset = line.closest.value[k];
        slope = line.direction[k];
    } else {
        offset = exact_dot(axis, axis_error, line.closest);
        slope = exact_dot(axis, axis_error, Sum3(line.direction, Real3(0.0)));
    }
    uint face = SLAB + 2u * k;
    return between_planes(offset, slope, box.low[k], face, box.high[k], face + 1u);
}

// A tie goes to the lowest axis.
Interval interval(Box box, BoxLine at) {
    Interval x = slab(box, at.line, box.axis_x, box.axis_x_error, 0u);
    Interval y = slab(box, at.line, box.axis_y, box.axis_y_error, 1u);
    Interval z = slab(box, at.line, box.axis_z, box.axis_z_error, 2u);
    return intersection(intersection(x, y), z);
}

// From the anchor, in the box's own axes.
Real3 in_axes(Box box, Real3 from_anchor) {
    if (ARE_BOXES_AXIS_ALIGNED) return from_anchor;
    return Real3(dot(box.axis_x, from_anchor), dot(box.axis_y, from_anchor), dot(box.axis_z, from_anchor));
}

// Distance from a point inside to the surface; negative outside, where its size is at most the distance.
Real depth(Box box, Real3 from_anchor) {
    Real3 below = box.high - abs(in_axes(box, from_anchor));
    return min(below.x, min(below.y, below.z));
}

// The same in a close-up, each face by so many times what the position of a point may be off across it.
Real depth_with_errors(Box box, Real3 from_anchor, Real place, Real errors) {
    Real3 x = abs(from_anchor);
    Real3 across = x;
    if (!ARE_BOXES_AXIS_ALIGNED)
        across = Real3(dot(abs(box.axis_x), x), dot(abs(box.axis_y), x), dot(abs(box.axis_z), x));
    Real3 at = in_axes(box, from_anchor);
    Real3 unit_errors = errors * SURFACE_ERROR * (Real3(place) + across);
    Real3 above_low = at - box.low + (unit_errors + errors * SURFACE_ERROR * abs(box.low));
    Real3 below_high = box.high - at + (unit_errors + errors * SURFACE_ERROR * abs(box.high));
    Real3 inside = min(above_low, below_high);
    return min(inside.x, min(inside.y, inside.z));
}

Real size(Box box) { return box.size; }

Real size_near(Box box, Real3 point) { return largest_component(point - box.anchor); }

// Outward unit normal and point of a face, scene space.
void surface(Box box, BoxLine at, Real s, uint face, out Real3 point, out Real3 normal) {
    uint axis = (face - SLAB) >> 1;
    bool positive = ((face - SLAB) & 1u) == 1u;
    Real3 across = axis == 0u ? box.axis_x : (axis == 1u ? box.axis_y : box.axis_z);
    Real3 planes = positive ? box.high : -box.low;
    Real plane = axis == 0u ? planes.x : (axis == 1u ? planes.y : planes.z);
    normal = positive ? across : -across;
    precise Real3 from_anchor = at.line.closest.value + (at.line.closest.error + s * at.line.direction);
    precise Real above = plane - dot(normal, from_anchor);
    precise Real3 on_face = box.anchor + (from_anchor + above * normal);
    point = on_face;
}
