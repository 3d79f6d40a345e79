// All kinds' hierarchies, for the next candidate of a ray.
#include "boxes_of_eight.glsl"
#include "proxies_of_eight.glsl"

#define IS_DEAR 0
#define SEARCH search_spheres
#define TRY_GROUPS try_groups_of_spheres
#define TRY_EIGHT try_eight_spheres
#define KEY_OF key_of_sphere
#define TIGHTEN tighten_by_sphere
#define PROXY_ROWS 1u
#define KIND 0u
#define LEVELS SPHERE_LEVELS
#include "hierarchy.glsl"
#undef SEARCH
#undef TRY_GROUPS
#undef TRY_EIGHT
#undef KEY_OF
#undef TIGHTEN
#undef PROXY_ROWS
#undef KIND
#undef LEVELS

#define SEARCH search_boxes
#define TRY_GROUPS try_groups_of_boxes
#define TRY_EIGHT try_eight_boxes
#define KEY_OF key_of_box
#define TIGHTEN tighten_by_box
#define PROXY_ROWS 2u
#define KIND 1u
#define LEVELS BOX_LEVELS
#include "hierarchy.glsl"
#undef SEARCH
#undef TRY_GROUPS
#undef TRY_EIGHT
#undef KEY_OF
#undef TIGHTEN
#undef KIND
#undef LEVELS

#undef IS_DEAR
#define IS_DEAR 1
#define SEARCH search_cylinders
#define TRY_GROUPS try_groups_of_cylinders
#define TRY_EIGHT try_eight_cylinders
#define KEY_OF key_of_cylinder
#define TIGHTEN tighten_by_cylinder
#define BOUNDING_SPHERE_OF bounding_sphere_of_cylinder
#define KIND 2u
#define LEVELS CYLINDER_LEVELS
#include "hierarchy.glsl"
#undef SEARCH
#undef TRY_GROUPS
#undef TRY_EIGHT
#undef KEY_OF
#undef TIGHTEN
#undef BOUNDING_SPHERE_OF
#undef KIND
#undef LEVELS

#define SEARCH search_cones
#define TRY_GROUPS try_groups_of_cones
#define TRY_EIGHT try_eight_cones
#define KEY_OF key_of_cone
#define TIGHTEN tighten_by_cone
#define BOUNDING_SPHERE_OF bounding_sphere_of_cone
#define KIND 3u
#define LEVELS CONE_LEVELS
#include "hierarchy.glsl"
#undef SEARCH
#undef TRY_GROUPS
#undef TRY_EIGHT
#undef KEY_OF
#undef TIGHTEN
#undef BOUNDING_SPHERE_OF
#undef PROXY_ROWS
#undef KIND
#undef LEVELS
#undef IS_DEAR

// A kind's search shrinks the limit for the next.
Found next_candidate(TraversalRay traversal, float limit, bool is_searching) {
    Found found = Found(NO_KEY, 0, NO_KEY, limit);
    // The direction of one ray of the packet, which decides the order for all.
    vec3 heading = of_packet(traversal.direction, 0u);
    if (HAS_SPHERES) search_spheres(traversal, heading, is_searching, found);
    if (HAS_BOXES) search_boxes(traversal, heading, is_searching, found);
    if (HAS_CYLINDERS) search_cylinders(traversal, heading, is_searching, found);
    if (HAS_CONES) search_cones(traversal, heading, is_searching, found);
    return found;
}
