// The exact solve of one candidate, of whatever kind, and which of two hits counts.

#define SOLID Sphere
#define SOLID_LINE SphereLine
#include "meet.glsl"
#undef SOLID
#undef SOLID_LINE

#define SOLID Box
#define SOLID_LINE BoxLine
#include "meet.glsl"
#undef SOLID
#undef SOLID_LINE

#define SOLID Cylinder
#define SOLID_LINE AxisLine
#include "meet.glsl"
#undef SOLID
#undef SOLID_LINE

#define SOLID Cone
#define SOLID_LINE AxisLine
#include "meet.glsl"
#undef SOLID
#undef SOLID_LINE

uint origin_of(OriginSurface origin_surface, uint slot) {
    if (origin_surface.slot == NOTHING) return FREE;
    return origin_surface.slot == slot ? OWN_INSIDE : OTHER_SURFACE;
}

// Where the ray meets the solid of a slot, if it does.
bool meet(uint slot, Ray ray, OriginSurface origin_surface, out Hit hit) {
    uint origin = origin_of(origin_surface, slot);
    uvec4 first = first_slots();
    bool is_met = false;
    // A kind alone needs not be distinguished from others.
    if (HAS_SPHERES && (IS_ONLY_KIND || slot < first.y)) {
        is_met = meet(sphere(slot), ray, origin, origin_surface.face, hit);
    } else if (HAS_BOXES && (IS_ONLY_KIND || slot < first.z)) {
        is_met = meet(box(slot - first.y), ray, origin, origin_surface.face, hit);
    } else if (HAS_CYLINDERS && (IS_ONLY_KIND || slot < first.w)) {
        is_met = meet(cylinder(slot - first.z), ray, origin, origin_surface.face, hit);
    } else if (HAS_CONES) {
        is_met = meet(cone(slot - first.w), ray, origin, origin_surface.face, hit);
    }
    hit.slot = slot;
    return is_met;
}

// Whether two hits may lie in one plane, as far as their numbers show. Each t is off by at most
// (u * t + 4u * size) / |cosine| (docs/numerics.md, T); unit normals are off by 4u each.
bool are_coplanar(Hit a, Hit b, Ray ray) {
    if (dot(a.normal, b.normal) < 1.0 - 16.0 * UNIT_ROUNDOFF) return false;
    Real error = UNIT_ROUNDOFF * (a.t + b.t + 4.0 * (a.size + b.size));
    return abs(a.t - b.t) * abs(dot(a.normal, ray.direction)) <= error;
}

// A tie goes to the primitive that the scene names first, and so does a plane that two faces share.
bool is_nearer(Hit hit, uint primitive, Hit nearest, uint nearest_primitive, Ray ray) {
    if (hit.t == nearest.t || are_coplanar(hit, nearest, ray)) return primitive < nearest_primitive;
    return hit.t < nearest.t;
}

// Whether a hit lies before a target at a distance along the ray. A target on the solid's surface, to rounding, is not
// hidden by it from the side the ray comes from.
bool is_before(Hit hit, Ray ray, Real3 target, Real distance) {
    Real height_of_target = (distance - hit.t) * abs(dot(hit.normal, ray.direction));
    return height_of_target > SURFACE_ERROR * (largest_component(target) + hit.size);
}
