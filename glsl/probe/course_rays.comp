#version 460
#extension GL_GOOGLE_include_directive : require
// Rays in, hits out: the course kernel's search for the nearest primitive, by its own listings.
layout(local_size_x = 64) in;

#include "course/interface.glsl"

struct ProbeRay {
    vec4 origin;
    vec4 direction; // unit
};

struct ProbeHit {
    vec3 point;
    float t;
    vec3 normal;
    float is_hit; // 1 or 0
};

layout(push_constant, std430) uniform Push { Frame frame; };
layout(binding = 0, std430) readonly buffer Rays { ProbeRay rays[]; };
layout(binding = 1, std140) uniform Spheres { Sphere spheres[MAX_PRIMITIVES]; };
layout(binding = 2, std140) uniform Boxes { Box boxes[MAX_PRIMITIVES]; };
layout(binding = 3, std140) uniform Cylinders { Cylinder cylinders[MAX_PRIMITIVES]; };
layout(binding = 4, std140) uniform Cones { Cone cones[MAX_PRIMITIVES]; };
layout(binding = 5, std430) buffer Hits { ProbeHit hits[]; };

#include "course/types.glsl"
#include "course/rounding.glsl"
#include "course/intersections.glsl"
#include "course/find_intersection.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    // The listings' `length` hides that of arrays: the host counts the rays.
    if (index >= uint(frame.depth)) return;
    Ray ray = Ray(rays[index].origin.xyz, rays[index].direction.xyz);
    Material none = Material(vec3(0.0), vec3(0.0));
    Intersection found = findIntersection(ray, frame.lens, Intersection(INF, vec3(0.0), vec3(0.0), none, ray));
    hits[index] = ProbeHit(found.point, found.t, found.normal, found.t < INF ? 1.0 : 0.0);
}
