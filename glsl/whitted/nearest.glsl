// The nearest hit among solids of all kinds, and whether anything lies before a point.

// `begin` and `end` count within each kind; `first_slot` is where the kind begins.
struct Ranges {
    uvec4 begin;
    uvec4 end;
    uvec4 first_slot;
};

// Whether two hits may lie in one plane, for all that their numbers tell. Each t is off by at most
// (u * t + 4u * size) / |cosine| (NUMERICS.md, T), and a bound's radius is no less than its solid's size; unit normals
// are off by 4u each.
bool are_coplanar(Hit a, Hit b, Ray ray) {
    if (dot(a.normal, b.normal) < 1.0 - 16.0 * UNIT_ROUNDOFF) return false;
    Real error = UNIT_ROUNDOFF * (a.t + b.t + 4.0 * (bounds[a.slot].w + bounds[b.slot].w));
    return abs(a.t - b.t) * abs(dot(a.normal, ray.direction)) <= error;
}

// A tie goes to the primitive that the scene names first, and so does a plane that two faces share.
bool is_nearer(Hit hit, Hit nearest, Ray ray) {
    if (nearest.slot == NOTHING) return true;
    if (hit.t == nearest.t || are_coplanar(hit, nearest, ray))
        return materials[hit.slot].primitive < materials[nearest.slot].primitive;
    return hit.t < nearest.t;
}

#define SOLID Sphere
#define SOLID_LINE SphereLine
#define SOLIDS spheres
#define NEAREST nearest_sphere
#define HIDES sphere_hides
#include "meet.glsl"
#include "search.glsl"
#undef SOLID
#undef SOLID_LINE
#undef SOLIDS
#undef NEAREST
#undef HIDES

#define SOLID Box
#define SOLID_LINE BoxLine
#define SOLIDS boxes
#define NEAREST nearest_box
#define HIDES box_hides
#include "meet.glsl"
#include "search.glsl"
#undef SOLID
#undef SOLID_LINE
#undef SOLIDS
#undef NEAREST
#undef HIDES

#define SOLID Cylinder
#define SOLID_LINE AxisLine
#define SOLIDS cylinders
#define NEAREST nearest_cylinder
#define HIDES cylinder_hides
#include "meet.glsl"
#include "search.glsl"
#undef SOLID
#undef SOLID_LINE
#undef SOLIDS
#undef NEAREST
#undef HIDES

#define SOLID Cone
#define SOLID_LINE AxisLine
#define SOLIDS cones
#define NEAREST nearest_cone
#define HIDES cone_hides
#include "meet.glsl"
#include "search.glsl"
#undef SOLID
#undef SOLID_LINE
#undef SOLIDS
#undef NEAREST
#undef HIDES

Hit nearest_hit(Ray ray, Departure departure, Ranges ranges) {
    Hit hit;
    hit.t = 0.0;
    hit.slot = NOTHING;
    uvec4 begin = ranges.begin, end = ranges.end, first = ranges.first_slot;
    if (HAS_SPHERES) nearest_sphere(ray, departure, begin[SPHERE], end[SPHERE], first[SPHERE], hit);
    if (HAS_BOXES) nearest_box(ray, departure, begin[BOX], end[BOX], first[BOX], hit);
    if (HAS_CYLINDERS) nearest_cylinder(ray, departure, begin[CYLINDER], end[CYLINDER], first[CYLINDER], hit);
    if (HAS_CONES) nearest_cone(ray, departure, begin[CONE], end[CONE], first[CONE], hit);
    return hit;
}

// Whether a solid lies on the ray before a target at a distance.
bool is_hidden(Ray ray, Departure departure, Real3 target, Real distance, Ranges ranges) {
    uvec4 begin = ranges.begin, end = ranges.end, first = ranges.first_slot;
    bool hidden = false;
    if (HAS_SPHERES)
        hidden = sphere_hides(ray, departure, target, distance, begin[SPHERE], end[SPHERE], first[SPHERE]);
    if (HAS_BOXES && !hidden)
        hidden = box_hides(ray, departure, target, distance, begin[BOX], end[BOX], first[BOX]);
    if (HAS_CYLINDERS && !hidden)
        hidden = cylinder_hides(ray, departure, target, distance, begin[CYLINDER], end[CYLINDER], first[CYLINDER]);
    if (HAS_CONES && !hidden)
        hidden = cone_hides(ray, departure, target, distance, begin[CONE], end[CONE], first[CONE]);
    return hidden;
}
