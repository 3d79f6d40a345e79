// One nappe cut by the slab between apex and base, with the base disk. About the axis every square of the textbook is
// a difference of two lengths, so that neither needles nor discs lose their digits.

AxisLine line_of(Cone cone, Ray ray) {
    Line line = recentred(ray, cone.apex, Real3(0.0));
    return about_axis(line, cone.axis, cone.axis_error, cone.reach);
}

// (cosine * x)^2 - (sine * y)^2
Real cone_difference(Cone cone, Real x, Real y) {
    precise Real across = cone.cosine * x;
    precise Real down = cone.sine * y;
    precise Real difference = (across - down) * (across + down);
    return difference;
}

// a*s^2 + 2*b*s + c <= 0: the double cone cos^2 * rho^2 <= sin^2 * z^2, rho the distance from the axis, z along it.
//
// Where the line leaves the double cone between its nappes (a < 0) only the half-line on this nappe counts. Where it
// stays on one nappe (a > 0) that may be the other one, which the slab then removes.
Interval nappe(Cone cone, AxisLine at) {
    Real3 offset = at.offset;
    Real along = at.along;
    precise Real slope_length = sqrt(at.slope_squared);
    precise Real offset_length = sqrt(dot(offset, offset));
    Real a = cone_difference(cone, slope_length, abs(at.along_slope));
    Real c = cone_difference(cone, offset_length, abs(along));
    precise Real b = cone.cosine * cone.cosine * dot(offset, at.slope) - cone.sine * cone.sine * along * at.along_slope;
#if COMPENSATION
    // b^2 - a*c = cos^2 * (sin^2 * |along*slope - along_slope*offset|^2 - cos^2 * moment^2)
    precise Real3 turn = along * at.slope - at.along_slope * offset;
    precise Real turn_length = sqrt(dot(turn, turn));
    precise Real discriminant = -cone.cosine * cone.cosine * cone_difference(cone, abs(at.moment), turn_length);
#else
    Real discriminant = b * b - a * c;
#endif
    bool ahead_is_down = at.along_slope > 0.0;
    Real low, high;
    Interval inside;
    if (a == 0.0) {
        // Parallel to the side. The sign of b, the same all along the line, shows whether it enters this nappe; b = 0
        // is the line through the apex, along the side itself.
        bool enters = b != 0.0 ? (b < 0.0) == ahead_is_down : c == 0.0;
        precise Real root = b != 0.0 ? -c / (b + b) : Real(0.0);
        low = root;
        high = root;
        if (!enters) return EMPTY;
    } else {
        // For a < 0 the discriminant is a sum of squares; only a line through the apex can round it below zero.
        if (a > 0.0 && discriminant < 0.0) return EMPTY;
        Real to_side = max(cone.cosine * offset_length, cone.sine * abs(along));
        ordered_roots(a, b, c, to_side * to_side, sqrt(max(discriminant, Real(0.0))), low, high);
    }
    if (a > 0.0) return Interval(low, high, CURVED, CURVED);
    return ahead_is_down ? Interval(high, LARGEST, CURVED, CURVED) : Interval(-LARGEST, low, CURVED, CURVED);
}

// One step of Newton's towards the side: where the line is nearly parallel to it, `a` keeps few digits, and so do the
// roots; the distance from the side keeps all.
Real nearer_to_side(Cone cone, AxisLine at, Real s, Real length) {
#if COMPENSATION
    Real3 radial = radial_at(at, s);
    precise Real distance = sqrt(dot(radial, radial));
    // Of a blunt cone the way along the axis is a small difference: it is rounded once.
    Sum3 place = add_scaled(at.line.closest, s, at.line.direction, Real3(0.0));
    Real along = exact_dot(cone.axis, cone.axis_error, place);
    precise Real above = cone.cosine * distance - cone.sine * along;
    precise Real change = cone.cosine * (dot(radial, at.slope) / distance) - cone.sine * at.along_slope;
    // Near the silhouette and the apex, where it would lead away, the root is good as it is.
    bool is_small = abs(above) < abs(change) * (0.0625 * length);
    precise Real corrected = s - above / change;
    return is_small ? corrected : s;
#else
    return s;
#endif
}

// A tie at the rim goes to the side.
Interval interval(Cone cone, AxisLine at) {
    Interval slab = axial_slab(at, Real(0.0), CURVED, cone.height, BASE);
    Interval side = nappe(cone, at);
    Interval inside = intersection(side, slab);
    if (inside.near > inside.far) return EMPTY;
    // Of the chord without the base, which may cut off all but a corner of it.
    Real length = side.far - side.near;
    inside.near = inside.near_face == CURVED ? nearer_to_side(cone, at, inside.near, length)
                                             : nearer_to_plane(at, cone.axis, cone.axis_error, cone.height, inside.near);
    inside.far = inside.far_face == CURVED ? nearer_to_side(cone, at, inside.far, length)
                                           : nearer_to_plane(at, cone.axis, cone.axis_error, cone.height, inside.far);
    return inside;
}

// Distance from a point inside to the surface; negative outside, where its size is at most the distance.
Real depth(Cone cone, Real3 from_anchor) {
    Real along = dot(from_anchor, cone.axis);
    Real3 radial = from_anchor - along * cone.axis;
    Real to_side = along * cone.sine - sqrt(dot(radial, radial)) * cone.cosine;
    // `along` counts only beyond the apex, where the side's lines come near.
    return min(to_side, min(along, cone.height - along));
}

// The same in a close-up, and so many times what the position of a point may be off.
Real depth_with_errors(Cone cone, Real3 from_anchor, Real place, Real errors) {
    return depth(cone, from_anchor) + errors * SURFACE_ERROR * (place + largest_component(from_anchor));
}

Real size(Cone cone) { return cone.size; }

Real size_near(Cone cone, Real3 point) { return largest_component(point - cone.apex); }

// Outward unit normal and point of a face, scene space. At the apex, where there is none, the normal is against the
// axis.
void surface(Cone cone, AxisLine at, Real s, uint face, out Real3 point, out Real3 normal) {
    Real3 radial = radial_at(at, s);
    Real along = along_at(at, s);
    precise Real distance = sqrt(dot(radial, radial));
    if (face == BASE) {
        normal = cone.axis;
        along = cone.height;
    } else if (distance > 0.0) {
        precise Real3 side = cone.cosine * (radial / distance) - cone.sine * cone.axis;
        precise Real above = cone.cosine * distance - cone.sine * along;
        normal = side;
        // Onto the side, at right angles to it.
        precise Real new_along = along + above * cone.sine;
        precise Real3 new_radial = radial - (above * cone.cosine / distance) * radial;
        along = new_along;
        radial = new_radial;
    } else {
        normal = -cone.axis;
    }
    precise Real3 from_apex = along * cone.axis + (radial + along * cone.axis_error);
    precise Real3 on_face = cone.apex + from_apex;
    point = on_face;
}
