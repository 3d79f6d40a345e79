// The infinite body cut by the slab between the bases.

AxisLine line_of(Cylinder cylinder, Ray ray) {
    Line line = recentred(ray, cylinder.center, cylinder.center_error);
    return about_axis(line, cylinder.axis, cylinder.axis_error, cylinder.reach);
}

// |offset + s * slope|^2 <= r^2. The discriminant is factored by Lagrange's identity: nothing cancels but r.
// The body about an anchor, as of a sphere: the height over it, where that is small, in lengths across the axis.
Real height_in_close_up(Cylinder cylinder, Real3 across) {
    precise Real bend = dot(across, across) / (2.0 * cylinder.radius);
    precise Real height = exact_dot(cylinder.slope, cylinder.slope_error, Sum3(across, Real3(0.0))) + (cylinder.offset + bend);
    return height;
}

Real depth_in_close_up(Cylinder cylinder, Real3 across) {
    Real3 from_axis = cylinder.radius * cylinder.slope + across;
    Real height = height_in_close_up(cylinder, across);
    return -2.0 * cylinder.radius * height / (cylinder.radius + sqrt(dot(from_axis, from_axis)));
}

Interval body_in_close_up(Cylinder cylinder, AxisLine at) {
    precise Real a = at.slope_squared / (2.0 * cylinder.radius);
    precise Real b = 0.5 * (exact_dot(cylinder.slope, cylinder.slope_error, Sum3(at.slope, Real3(0.0))) +
                            dot(at.offset, at.slope) / cylinder.radius);
    precise Real c = height_in_close_up(cylinder, at.offset);
    if (at.slope_squared == 0.0) return c <= 0.0 ? WHOLE_LINE : EMPTY;
    precise Real discriminant = b * b - a * c;
    if (discriminant < 0.0) return EMPTY;
    Real low, high;
    ordered_roots(a, b, c, Real(0.0), sqrt(discriminant), low, high);
    return Interval(low, high, CURVED, CURVED);
}

Interval body(Cylinder cylinder, AxisLine at) {
    if (IS_CLOSE_UP) return body_in_close_up(cylinder, at);
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
    Real plane = face == END ? cylinder.low : cylinder.half_length;
    return nearer_to_plane(at, cylinder.axis, cylinder.axis_error, plane, s);
}

// A tie at the rim goes to the body.
Interval interval(Cylinder cylinder, AxisLine at) {
    Interval slab = axial_slab(at, cylinder.low, END, cylinder.half_length, END + 1u);
    Interval inside = intersection(body(cylinder, at), slab);
    if (inside.near_face != CURVED) inside.near = nearer_to_base(cylinder, at, inside.near_face, inside.near);
    if (inside.far_face != CURVED) inside.far = nearer_to_base(cylinder, at, inside.far_face, inside.far);
    return inside;
}

// Distance from a point inside to the surface; negative outside.
Real depth(Cylinder cylinder, Real3 from_anchor) {
    Real along = dot(from_anchor, cylinder.axis);
    Real3 radial = from_anchor - along * cylinder.axis;
    return min(cylinder.radius - sqrt(dot(radial, radial)), cylinder.half_length - abs(along));
}

// The same in a close-up, each face by so many times what the place of a point may be off across it.
Real depth_with_errors(Cylinder cylinder, Real3 from_anchor, Real place, Real errors) {
    Real along = dot(from_anchor, cylinder.axis);
    Real3 radial = from_anchor - along * cylinder.axis;
    Real unit_error = errors * SURFACE_ERROR;
    Real ends_error = unit_error * (place + dot(abs(cylinder.axis), abs(from_anchor)));
    Real above_low = along - cylinder.low + (ends_error + unit_error * abs(cylinder.low));
    Real below_high = cylinder.half_length - along + (ends_error + unit_error * abs(cylinder.half_length));
    Real body_error = unit_error * (place + largest_component(radial) + abs(cylinder.offset));
    Real in_body = depth_in_close_up(cylinder, radial) + body_error;
    return min(in_body, min(above_low, below_high));
}

Real size(Cylinder cylinder) { return cylinder.size; }

Real size_near(Cylinder cylinder, Real3 point) { return largest_component(point - cylinder.center); }

// Outward unit normal and point of a face, scene space.
void surface(Cylinder cylinder, AxisLine at, Real s, uint face, out Real3 point, out Real3 normal) {
    Real3 radial = radial_at(at, s);
    Real along = along_at(at, s);
    if (IS_CLOSE_UP && face == CURVED) {
        normal = unit(cylinder.slope + radial / cylinder.radius);
        radial += depth_in_close_up(cylinder, radial) * normal;
    } else if (face == CURVED) {
        normal = unit(radial);
        radial = cylinder.radius * normal;
    } else {
        normal = face == END ? -cylinder.axis : cylinder.axis;
        along = face == END ? cylinder.low : cylinder.half_length;
    }
    precise Real3 from_center = along * cylinder.axis + (radial + (along * cylinder.axis_error + cylinder.center_error));
    precise Real3 on_face = cylinder.center + from_center;
    point = on_face;
}
