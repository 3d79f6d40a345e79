// Half chord by Pythagoras, from the line's closest point to either end; without compensation, the quadratic.

struct SphereLine {
    Line line;
};

SphereLine line_of(Sphere sphere, Ray ray) {
    return SphereLine(recentred(ray, sphere.center, Real3(0.0)));
}

Interval interval(Sphere sphere, SphereLine at) {
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

Real size(Sphere sphere) { return sphere.radius; }

// Outward unit normal and point of a face, kernel frame.
void surface(Sphere sphere, SphereLine at, Real s, uint face, out Real3 point, out Real3 normal) {
    precise Real3 from_center = at.line.closest.value + (at.line.closest.error + s * at.line.direction);
    normal = unit(from_center);
    precise Real3 on_sphere = sphere.center + sphere.radius * normal;
    point = on_sphere;
}
