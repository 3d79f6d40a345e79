// The intersection of three slabs (Kay and Kajiya 1986).

struct BoxLine {
    Line line;
};

BoxLine line_of(Box box, Ray ray) {
    return BoxLine(recentred(ray, box.center, Real3(0.0)));
}

Interval slab(Line line, Real3 axis, Real3 axis_error, Real half_size, uint face) {
    Real offset = exact_dot(axis, axis_error, line.closest);
    Real slope = exact_dot(axis, axis_error, Sum3(line.direction, Real3(0.0)));
    return between_planes(offset, slope, -half_size, face, half_size, face + 1u);
}

// A tie goes to the lowest axis.
Interval interval(Box box, BoxLine at) {
    Interval x = slab(at.line, box.axis_x, box.axis_x_error, box.half_x, SLAB);
    Interval y = slab(at.line, box.axis_y, box.axis_y_error, box.half_y, SLAB + 2u);
    Interval z = slab(at.line, box.axis_z, box.axis_z_error, box.half_z, SLAB + 4u);
    return intersection(intersection(x, y), z);
}

// Distance from a point inside to the surface; negative outside, where its size is at most the distance.
Real depth(Box box, Real3 from_anchor) {
    Real x = box.half_x - abs(dot(box.axis_x, from_anchor));
    Real y = box.half_y - abs(dot(box.axis_y, from_anchor));
    Real z = box.half_z - abs(dot(box.axis_z, from_anchor));
    return min(x, min(y, z));
}

Real size(Box box) { return box.size; }

// Outward unit normal and point of a face, kernel frame.
void surface(Box box, BoxLine at, Real s, uint face, out Real3 point, out Real3 normal) {
    uint axis = (face - SLAB) >> 1;
    bool positive = ((face - SLAB) & 1u) == 1u;
    Real3 across = axis == 0u ? box.axis_x : (axis == 1u ? box.axis_y : box.axis_z);
    Real half_size = axis == 0u ? box.half_x : (axis == 1u ? box.half_y : box.half_z);
    normal = positive ? across : -across;
    precise Real3 from_center = at.line.closest.value + (at.line.closest.error + s * at.line.direction);
    precise Real above = half_size - dot(normal, from_center);
    precise Real3 on_face = box.center + (from_center + above * normal);
    point = on_face;
}
