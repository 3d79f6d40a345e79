#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Rays in, hits out: the accurate kernel's intersections one by one, by the kernel's own include files. Each ray is
// tested against one solid alone.
layout(local_size_x = 64) in;

#include "records/records.glsl"
#include "solids/solids.glsl"
#include "search/traversal.glsl"
#include "search/proxies.glsl"

// The key of a solid's proxy, as if it were the only one.
uint key_alone(uint slot, TraversalRay traversal) {
    uvec4 first = first_slots(), rows = frame.proxies;
    uvec4 row = rows + uvec4(1u, 2u, 2u, 2u) * (slot - first);
    if (HAS_CONES && slot >= first.w) {
        vec4 a = texelFetch(proxies, int(row.w)), b = texelFetch(proxies, int(row.w + 1u));
        return key_of_cone(a, b, traversal, 0, 0u) | uint(misses_sphere(bounding_sphere_of_cone(a, b), traversal));
    }
    if (HAS_CYLINDERS && slot >= first.z) {
        vec4 a = texelFetch(proxies, int(row.z)), b = texelFetch(proxies, int(row.z + 1u));
        return key_of_cylinder(a, b, traversal, 0, 0u) | uint(misses_sphere(bounding_sphere_of_cylinder(a, b), traversal));
    }
    if (HAS_BOXES && slot >= first.y)
        return key_of_box(texelFetch(proxies, int(row.y)), texelFetch(proxies, int(row.y + 1u)), traversal, 0, 0u);
    return key_of_sphere(texelFetch(proxies, int(row.x)), vec4(0.0), traversal, 0, 0u);
}

struct ProbeRay {
    Real3 origin;
    Real slot;        // of the solid to test
    Real3 direction;  // unit
    Real origin_surface;   // whose surface the origin lies on: < 0 none, 0 this solid's, 1 another's
    Real face;        // of that surface
    Real inside;      // 1 where the ray leaves it inwards
    Real unused_0;
    Real unused_1;
};

struct ProbeHit {
    Real3 point;
    Real t;
    Real3 normal;
    Real primitive;   // index in the scene, or -1
    Real face;
    Real inside;
    Real unused_0;
    Real unused_1;
};

layout(binding = 0, std430) readonly buffer Rays { ProbeRay rays[]; };
layout(binding = 8, std430) buffer Hits { ProbeHit hits[]; };

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= uint(rays.length())) return;
    ProbeRay probed = rays[index];
    uint slot = uint(probed.slot);
    OriginSurface origin_surface = OriginSurface(NOTHING, CURVED, false);
    if (probed.origin_surface >= 0.0) {
        // No slot is that large: another's.
        uint left = probed.origin_surface == 0.0 ? slot : NOTHING - 1u;
        origin_surface = OriginSurface(left, uint(probed.face), probed.inside == 1.0);
    }
    Ray ray = Ray(probed.origin, Real3(0.0), probed.direction);
    Hit hit;
    bool is_met = meet(slot, ray, origin_surface, hit);
    bool is_own = origin_surface.slot == slot;
    // As in a search: what its proxy says is missed, or met later, is not met.
    uint key = key_alone(slot, traversal_ray_of(ray));
    is_met = is_met && (is_own ? origin_surface.inside : key < NO_KEY && key <= (floatBitsToUint(float(hit.t)) | 7u));

    ProbeHit result;
    result.primitive = -1.0;
    if (is_met) {
        result.point = hit.point;
        result.t = hit.t;
        result.normal = hit.normal;
        result.primitive = Real(material(slot).primitive);
        result.face = Real(hit.face);
        result.inside = hit.inside ? 1.0 : 0.0;
    }
    hits[index] = result;
}
