#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Rays in, hits out: the accurate kernel's intersections one by one, by the kernel's own include files. Each ray is
// tried on one solid alone.
layout(local_size_x = 64) in;

#include "whitted/solids.glsl"

struct ProbeRay {
    Real3 origin;
    Real slot;        // of the solid to try
    Real3 direction;  // unit
    Real departure;   // of which primitive's surface the origin lies on: < 0 none, 0 this solid's, 1 another's
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
    Departure departure = Departure(NOTHING, CURVED, false);
    if (probed.departure >= 0.0) {
        // No slot is that large: another's.
        uint left = probed.departure == 0.0 ? slot : NOTHING - 1u;
        departure = Departure(left, uint(probed.face), probed.inside == 1.0);
    }
    // The one slot as a range of its kind, the others empty.
    Ranges scene = whole_scene();
    uvec4 place = uvec4(slot) - scene.first_slot;
    uvec4 begin = min(place, scene.end);
    bvec4 is_kind = bvec4(slot >= scene.first_slot.x && place.x < scene.end.x,
                          slot >= scene.first_slot.y && place.y < scene.end.y,
                          slot >= scene.first_slot.z && place.z < scene.end.z,
                          slot >= scene.first_slot.w && place.w < scene.end.w);
    uvec4 end = begin + uvec4(is_kind);
    Hit hit = nearest_hit(Ray(probed.origin, probed.direction), departure, Ranges(begin, end, scene.first_slot));

    ProbeHit result;
    result.primitive = -1.0;
    if (hit.slot != NOTHING) {
        result.point = hit.point;
        result.t = hit.t;
        result.normal = hit.normal;
        result.primitive = materials[hit.slot].primitive;
        result.face = Real(hit.face);
        result.inside = hit.inside ? 1.0 : 0.0;
    }
    hits[index] = result;
}
