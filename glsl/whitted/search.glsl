// All kinds' hierarchies, for the next candidate of a ray.
#include "boxes_of_eight.glsl"
#include "outlines_of_eight.glsl"

#define IS_DEAR 0
#define SEARCH search_spheres
#define TRY_GROUPS try_groups_of_spheres
#define TRY_EIGHT try_eight_spheres
#define KEY_OF key_of_sphere
#define SETTLE settle_sphere
#define OUTLINE_ROWS 1u
#define KIND 0u
#define LEVELS SPHERE_LEVELS
#include "hierarchy.glsl"
#undef SEARCH
#undef TRY_GROUPS
#undef TRY_EIGHT
#undef KEY_OF
#undef SETTLE
#undef OUTLINE_ROWS
#undef KIND
#undef LEVELS

#define SEARCH search_boxes
#define TRY_GROUPS try_groups_of_boxes
#define TRY_EIGHT try_eight_boxes
#define KEY_OF key_of_box
#define SETTLE settle_box
#define OUTLINE_ROWS 2u
#define KIND 1u
#define LEVELS BOX_LEVELS
#include "hierarchy.glsl"
#undef SEARCH
#undef TRY_GROUPS
#undef TRY_EIGHT
#undef KEY_OF
#undef SETTLE
#undef KIND
#undef LEVELS

#undef IS_DEAR
#define IS_DEAR 1
#define SEARCH search_cylinders
#define TRY_GROUPS try_groups_of_cylinders
#define TRY_EIGHT try_eight_cylinders
#define KEY_OF key_of_cylinder
#define SETTLE settle_cylinder
#define BALL_OF ball_of_cylinder
#define KIND 2u
#define LEVELS CYLINDER_LEVELS
#include "hierarchy.glsl"
#undef SEARCH
#undef TRY_GROUPS
#undef TRY_EIGHT
#undef KEY_OF
#undef SETTLE
#undef BALL_OF
#undef KIND
#undef LEVELS

#define SEARCH search_cones
#define TRY_GROUPS try_groups_of_cones
#define TRY_EIGHT try_eight_cones
#define KEY_OF key_of_cone
#define SETTLE settle_cone
#define BALL_OF ball_of_cone
#define KIND 3u
#define LEVELS CONE_LEVELS
#include "hierarchy.glsl"
#undef SEARCH
#undef TRY_GROUPS
#undef TRY_EIGHT
#undef KEY_OF
#undef SETTLE
#undef BALL_OF
#undef OUTLINE_ROWS
#undef KIND
#undef LEVELS
#undef IS_DEAR

// A kind's search shrinks the limit for the next.
Found next_candidate(Beam beam, float limit, bool is_searching) {
    Found found = Found(NO_KEY, 0, NO_KEY, limit);
    // The direction of one ray of the packet, which decides the order for all.
    vec3 heading = of_packet(beam.direction, 0u);
    if (HAS_SPHERES) search_spheres(beam, heading, is_searching, found);
    if (HAS_BOXES) search_boxes(beam, heading, is_searching, found);
    if (HAS_CYLINDERS) search_cylinders(beam, heading, is_searching, found);
    if (HAS_CONES) search_cones(beam, heading, is_searching, found);
    return found;
}
