// A line about its point nearest to an axis through the anchor: what is across a thin solid must not drown in the
// rounding of what is along it.

struct AxisLine {
    // Recentred once more: `closest` is the point nearest to the axis, if that is within reach of the anchor.
    Line line;
    Real along;         // coordinate on the axis there ...
    Real along_slope;   // ... and its change per length of the direction
    Real3 offset;       // from the axis, perpendicular to it, there ...
    Real3 slope;        // ... and its change; their errors are relative to themselves
    Real slope_squared;
    Real moment;        // axis . (offset x slope)
};

AxisLine about_axis(Line line, Real3 axis, Real3 axis_error, Real reach) {
    AxisLine at;
    Real along_slope = exact_dot(axis, axis_error, Sum3(line.direction, Real3(0.0)));
    // Rounding of the factor only moves along the axis, which the second step takes away.
    Sum3 slope = add_scaled(Sum3(line.direction, Real3(0.0)), -along_slope, axis, axis_error);
    precise Real3 across_slope = slope.value - axis * dot(axis, slope.value);
    at.along_slope = along_slope;
    at.slope = across_slope;
    at.slope_squared = dot(across_slope, across_slope);

    // A line that meets the solid does so within reach of its point closest to the anchor.
    precise Real unlimited = -dot(line.closest.value, across_slope) / at.slope_squared;
    bool is_recentred = COMPENSATION != 0 && at.slope_squared > 0.0;
    Real s_nearest = is_recentred ? clamp(unlimited, -reach, reach) : Real(0.0);
    Sum3 nearest = add_scaled(line.closest, s_nearest, line.direction, Real3(0.0));
    at.line = line;
    at.line.closest = nearest;
    // |t_rest| is some u * t_closest, and may be the larger of the two.
    Sum3 t_rest = two_sum(Real3(line.t_rest), Real3(s_nearest));
    at.line.t_rest = t_rest.value.x;
    at.line.t_error = t_rest.error.x;
    Real along = exact_dot(axis, axis_error, nearest);
    Sum3 offset = add_scaled(nearest, -along, axis, axis_error);
    precise Real3 across = offset.value - axis * dot(axis, offset.value);
    at.along = along;
    at.offset = across;
    precise Real moment = dot(axis, cross(across, across_slope));
    at.moment = moment;
    return at;
}

// From the axis, perpendicular to it.
Real3 radial_at(AxisLine at, Real s) {
    precise Real3 radial = at.offset + s * at.slope;
    return radial;
}

Real along_at(AxisLine at, Real s) {
    precise Real along = at.along + s * at.along_slope;
    return along;
}

// One step of Newton's towards a plane across the axis, with the distance from it rounded about once: far from its
// point the slab's quotient has lost some u of the reach.
Real nearer_to_plane(AxisLine at, Real3 axis, Real3 axis_error, Real plane, Real s) {
#if COMPENSATION
    Sum3 place = add_scaled(at.line.closest, s, at.line.direction, Real3(0.0));
    precise Real beyond = exact_dot(axis, axis_error, place) - plane;
    precise Real corrected = s - beyond / at.along_slope;
    return corrected;
#else
    return s;
#endif
}

// The axial slab [low, high].
Interval axial_slab(AxisLine at, Real low, uint low_face, Real high, uint high_face) {
    return between_planes(at.along, at.along_slope, low, low_face, high, high_face);
}
