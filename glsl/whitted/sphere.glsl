// Half chord by Pythagoras, from the line's closest point to either end; without compensation, the quadratic.

struct SphereLine {
    Line line;
};

SphereLine line_of(Sphere sphere, Ray ray) {
    return SphereLine(recentred(ray, sphere.center, Real3(0.0)));
}

// offset + slope . x + |x|^2 / (2 * radius): about the height above the sphere, where that is small.
Real height_in_close_up(Sphere sphere, Sum3 x) {
    precise Real bend = dot(x.value, x.value) / (2.0 * sphere.radius);
    precise Real height = exact_dot(sphere.slope, sphere.slope_error, x) + (sphere.offset + bend);
    return height;
}

// The quadratic of that along the line. Nothing cancels in it but heights.
Interval interval_in_close_up(Sphere sphere, Line line) {
    precise Real a = line.direction_squared / (2.0 * sphere.radius);
    precise Real b = 0.5 * (exact_dot(sphere.slope, sphere.slope_error, Sum3(line.direction, Real3(0.0))) +
                            dot(line.closest.value, line.direction) / sphere.radius);
    precise Real c = height_in_close_up(sphere, line.closest);
    precise Real discriminant = b * b - a * c;
    if (discriminant < 0.0) return EMPTY;
    Real low, high;
    ordered_roots(a, b, c, Real(0.0), sqrt(discriminant), low, high);
    return Interval(low, high, CURVED, CURVED);
}

Interval interval(Sphere sphere, SphereLine at) {
    if (IS_CLOSE_UP) return interval_in_close_up(sphere, at.line);
#if COMPENSATION
    precise Real distance_squared =
        dot(at.line.closest.value, at.line.closest.value) + 2.0 * dot(at.line.closest.value, at.line.closest.error);
    precise Real half_chord_squared = sphere.radius * sphere.radius - distance_squared;
    precise Real s = sqrt(max(half_chord_squared, Real(0.0)) / at.line.direction_squared);
    if (half_chord_squared < 0.0) return EMPTY;
    return Interval(-s, s, CURVED, CURVED);
#else
    Real3 offset = at.line.closest.value;
    Real a = at.line.direction_squared;
    Real b = dot(offset, at.line.direction);
    Real c = dot(offset, offset) - sphere.radius * sphere.radius;
    Real discriminant = b * b - a * c;
    if (discriminant < 0.0) return EMPTY;
    return Interval((-b - sqrt(discriminant)) / a, (-b + sqrt(discriminant)) / a, CURVED, CURVED);
#endif
}

// Distance from a point inside to the surface; negative outside.
Real depth(Sphere sphere, Real3 from_anchor) {
    return sphere.radius - sqrt(dot(from_anchor, from_anchor));
}

// From |slope * radius + x| = radius where the height is 0.
Real depth_in_close_up(Sphere sphere, Sum3 x) {
    Real3 from_center = sphere.radius * sphere.slope + x.value;
    Real height = height_in_close_up(sphere, x);
    return -2.0 * sphere.radius * height / (sphere.radius + sqrt(dot(from_center, from_center)));
}

Real depth_with_errors(Sphere sphere, Real3 from_anchor, Real place, Real errors) {
    Real size = largest_component(from_anchor) + abs(sphere.offset);
    return depth_in_close_up(sphere, Sum3(from_anchor, Real3(0.0))) + errors * SURFACE_ERROR * (place + size);
}

Real size(Sphere sphere) { return sphere.radius; }

Real size_near(Sphere sphere, Real3 point) { return largest_component(point - sphere.center); }

// Outward unit normal and point of a face, scene space.
void surface(Sphere sphere, SphereLine at, Real s, uint face, out Real3 point, out Real3 normal) {
    if (IS_CLOSE_UP) {
        precise Real3 from_anchor = at.line.closest.value + (at.line.closest.error + s * at.line.direction);
        normal = unit(sphere.slope + from_anchor / sphere.radius);
        precise Real3 on_surface = from_anchor + depth_in_close_up(sphere, Sum3(from_anchor, Real3(0.0))) * normal;
        precise Real3 seen = sphere.center + on_surface;
        point = seen;
        return;
    }
    precise Real3 from_center = at.line.closest.value + (at.line.closest.error + s * at.line.direction);
    normal = unit(from_center);
    precise Real3 on_sphere = sphere.center + sphere.radius * normal;
    point = on_sphere;
}
