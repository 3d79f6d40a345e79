// All kinds' hierarchies, for the next candidate of a ray.
#include "traversal.glsl"
#include "proxies.glsl"
#include "boxes.glsl"
#if PACKETS
#include "boxes_of_eight.glsl"
#include "proxies_of_eight.glsl"
#else
#include "boxes_by_ray.glsl"
#endif

#define SPHERES 0
#define BOXES 1
#define CYLINDERS 2
#define CONES 3

#define KIND SPHERES
#include "hierarchy.glsl"
#undef KIND
#define KIND BOXES
#include "hierarchy.glsl"
#undef KIND
#define KIND CYLINDERS
#include "hierarchy.glsl"
#undef KIND
#define KIND CONES
#include "hierarchy.glsl"
#undef KIND

// A kind's search shrinks the limit for the next.
Found next_candidate(TraversalRay traversal, float limit, bool is_searching) {
    Found found = Found(NO_KEY, 0, NO_KEY, limit);
    if (HAS_SPHERES) search_sphere(traversal, is_searching, found);
    if (HAS_BOXES) search_box(traversal, is_searching, found);
    if (HAS_CYLINDERS) search_cylinder(traversal, is_searching, found);
    if (HAS_CONES) search_cone(traversal, is_searching, found);
    return found;
}
