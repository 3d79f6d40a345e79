// Half chord by Pythagoras, from the line's closest point to either end; without compensation, the quadratic.

struct SphereLine {
    Line line;
};

SphereLine line_of(Sphere sphere, Ray ray) {
    return SphereLine(recentred(ray, sphere.anchor, Real3(0.0)));
}

Interval interval(Sphere sphere, SphereLine at) {
    if (IS_CLOSE_UP)
        return interval(sphere.curve, sphere.radius, at.line.closest, at.line.direction, at.line.direction_squared);
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

// The same in a close-up, and so many times what the position of a point may be off.
Real depth_with_errors(Sphere sphere, Real3 from_anchor, Real place, Real errors) {
    Real size = largest_component(from_anchor) + abs(sphere.curve.offset);
    return depth(sphere.curve, sphere.radius, Sum3(from_anchor, Real3(0.0))) + errors * SURFACE_ERROR * (place + size);
}

Real size(Sphere sphere) { return sphere.radius; }

Real size_near(Sphere sphere, Real3 point) { return largest_component(point - sphere.anchor); }

// Outward unit normal and point of a face, scene space.
void surface(Sphere sphere, SphereLine at, Real s, uint face, out Real3 point, out Real3 normal) {
    precise Real3 from_anchor = at.line.closest.value + (at.line.closest.error + s * at.line.direction);
    Real3 place;
    if (IS_CLOSE_UP) {
        normal = normal_of(sphere.curve, sphere.radius, from_anchor);
        Real below = depth(sphere.curve, sphere.radius, Sum3(from_anchor, Real3(0.0)));
        precise Real3 on_curve = from_anchor + below * normal;
        place = on_curve;
    } else {
        normal = unit(from_anchor);
        precise Real3 on_radius = sphere.radius * normal;
        place = on_radius;
    }
    precise Real3 on_sphere = sphere.anchor + place;
    point = on_sphere;
}
