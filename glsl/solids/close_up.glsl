// Round surfaces of a close-up: of a sphere, and of a cylinder across its axis. Rust has the same in
// src/plan/rounding/sides.rs.

// offset + slope . x + |x|^2 / (2 * radius): about the height of x, seen from the anchor, over the surface, where that
// is small.
Real height(Curve curve, Real radius, Sum3 x) {
    precise Real bend = dot(x.value, x.value) / (2.0 * radius);
    precise Real height = exact_dot(curve.slope, curve.slope_error, x) + (curve.offset + bend);
    return height;
}

// Distance from a point inside to the surface; negative outside. |slope * radius + x| is the radius where the height is
// 0.
Real depth(Curve curve, Real radius, Sum3 x) {
    Real3 from_center = radius * curve.slope + x.value;
    return -2.0 * radius * height(curve, radius, x) / (radius + sqrt(dot(from_center, from_center)));
}

// The part of a line, x + s * direction, that is inside. Nothing cancels in that quadratic but heights.
Interval interval(Curve curve, Real radius, Sum3 x, Real3 direction, Real direction_squared) {
    precise Real a = direction_squared / (2.0 * radius);
    precise Real b = 0.5 * (exact_dot(curve.slope, curve.slope_error, Sum3(direction, Real3(0.0))) +
                            dot(x.value, direction) / radius);
    precise Real c = height(curve, radius, x);
    if (direction_squared == 0.0) return c <= 0.0 ? WHOLE_LINE : EMPTY;
    precise Real discriminant = b * b - a * c;
    if (discriminant < 0.0) return EMPTY;
    Real low, high;
    ordered_roots(a, b, c, Real(0.0), sqrt(discriminant), low, high);
    return Interval(low, high, CURVED, CURVED);
}

// Outward unit normal at x.
Real3 normal_of(Curve curve, Real radius, Real3 x) { return unit(curve.slope + x / radius); }
