// The search through the solids of a kind, included once for each: KIND is the kind, OF_KIND makes a function's name
// for it, LEVELS is the number of levels over the solids, PROXY_ROWS how many rows a proxy takes. Where IS_DEAR, a
// proxy's key takes so long to find that a packet first tests a bounding sphere around the solid.
//
// The solids lie in such an order that each eight that begin with a multiple of eight are near each other, and so are
// each eight of these groups, and so on: level h holds a box around every 8^h of them, and the position of a box gives
// its contents. src/tracer/whitted/hierarchy.rs makes the order, and the boxes.

#if KIND == SPHERES
#define OF_KIND(function) function##_sphere
#define LEVELS SPHERE_LEVELS
#define PROXY_ROWS 1u
#define IS_DEAR 0
#elif KIND == BOXES
#define OF_KIND(function) function##_box
#define LEVELS BOX_LEVELS
#define PROXY_ROWS 2u
#define IS_DEAR 0
#elif KIND == CYLINDERS
#define OF_KIND(function) function##_cylinder
#define LEVELS CYLINDER_LEVELS
#define PROXY_ROWS 2u
#define IS_DEAR 1
#elif KIND == CONES
#define OF_KIND(function) function##_cone
#define LEVELS CONE_LEVELS
#define PROXY_ROWS 2u
#define IS_DEAR 1
#endif

#if PACKETS
#include "by_packet.glsl"
#else
#include "by_ray.glsl"
#endif

#undef OF_KIND
#undef LEVELS
#undef PROXY_ROWS
#undef IS_DEAR
