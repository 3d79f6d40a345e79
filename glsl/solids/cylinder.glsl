// The infinite body cut by the slab between the bases.

AxisLine line_of(Cylinder cylinder, Ray ray) {
    Line line = recentred(ray, cylinder.anchor, cylinder.anchor_error);
    return about_axis(line, cylinder.axis, cylinder.axis_error, cylinder.reach);
}

// |offset + s * slope|^2 <= r^2. The discriminant is factored by Lagrange's identity: nothing cancels but r.
Interval body(Cylinder cylinder, AxisLine at) {
    if (IS_CLOSE_UP)
        return interval(cylinder.curve, cylinder.radius, Sum3(at.offset, Real3(0.0)), at.slope, at.slope_squared);
    Real radius = cylinder.radius;
    Real b = dot(at.offset, at.slope);
    precise Real distance = sqrt(dot(at.offset, at.offset));
    if (at.slope_squared == 0.0) return distance <= radius ? WHOLE_LINE : EMPTY;
    precise Real c = (distance - radius) * (distance + radius);
#if COMPENSATION
    precise Real reach = radius * sqrt(at.slope_squared);
    precise Real moment = abs(at.moment);
    precise Real discriminant = (reach - moment) * (reach + moment);
#else
    Real discriminant = b * b - at.slope_squared * c;
#endif
    if (discriminant < 0.0) return EMPTY;
    Real low, high;
    ordered_roots(at.slope_squared, b, c, radius * radius, sqrt(discriminant), low, high);
    return Interval(low, high, CURVED, CURVED);
}

Real nearer_to_base(Cylinder cylinder, AxisLine at, uint face, Real s) {
    Real plane = face == END ? cylinder.low : cylinder.high;
    return nearer_to_plane(at, cylinder.axis, cylinder.axis_error, plane, s);
}

// A tie at the rim goes to the body.
Interval interval(Cylinder cylinder, AxisLine at) {
    Interval slab = axial_slab(at, cylinder.low, END, cylinder.high, END + 1u);
    Interval inside = intersection(body(cylinder, at), slab);
    if (inside.near_face != CURVED) inside.near = nearer_to_base(cylinder, at, inside.near_face, inside.near);
    if (inside.far_face != CURVED) inside.far = nearer_to_base(cylinder, at, inside.far_face, inside.far);
    return inside;
}

// Distance from a point inside to the surface; negative outside.
Real depth(Cylinder cylinder, Real3 from_anchor) {
    Real along = dot(from_anchor, cylinder.axis);
    Real3 radial = from_anchor - along * cylinder.axis;
    return min(cylinder.radius - sqrt(dot(radial, radial)), cylinder.high - abs(along));
}

// The same in a close-up, each face by so many times what the position of a point may be off across it.
Real depth_with_errors(Cylinder cylinder, Real3 from_anchor, Real place, Real errors) {
    Real along = dot(from_anchor, cylinder.axis);
    Real3 radial = from_anchor - along * cylinder.axis;
    Real unit_error = errors * SURFACE_ERROR;
    Real ends_error = unit_error * (place + dot(abs(cylinder.axis), abs(from_anchor)));
    Real above_low = along - cylinder.low + (ends_error + unit_error * abs(cylinder.low));
    Real below_high = cylinder.high - along + (ends_error + unit_error * abs(cylinder.high));
    Real body_error = unit_error * (place + largest_component(radial) + abs(cylinder.curve.offset));
    Real in_body = depth(cylinder.curve, cylinder.radius, Sum3(radial, Real3(0.0))) + body_error;
    return min(in_body, min(above_low, below_high));
}

Real size(Cylinder cylinder) { return cylinder.size; }

Real size_near(Cylinder cylinder, Real3 point) { return largest_component(point - cylinder.anchor); }

// Outward unit normal and point of a face, scene space.
void surface(Cylinder cylinder, AxisLine at, Real s, uint face, out Real3 point, out Real3 normal) {
    Real3 radial = radial_at(at, s);
    Real along = along_at(at, s);
    if (IS_CLOSE_UP && face == CURVED) {
        normal = normal_of(cylinder.curve, cylinder.radius, radial);
        radial += depth(cylinder.curve, cylinder.radius, Sum3(radial, Real3(0.0))) * normal;
    } else if (face == CURVED) {
        normal = unit(radial);
        radial = cylinder.radius * normal;
    } else {
        normal = face == END ? -cylinder.axis : cylinder.axis;
        along = face == END ? cylinder.low : cylinder.high;
    }
    precise Real3 from_anchor = along * cylinder.axis + (radial + (along * cylinder.axis_error + cylinder.anchor_error));
    precise Real3 on_face = cylinder.anchor + from_anchor;
    point = on_face;
}
