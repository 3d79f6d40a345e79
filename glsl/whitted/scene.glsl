// The scene as it lies in memory: rows of four reals, so that the layout is the same for float and double.
// src/tracer/whitted_records.rs writes them.
//
// Kernel frame: the world frame with the camera at its origin, times a power of two that brings the largest primitive
// to about 1. Within a kind the scene's order is kept; the kinds lie behind each other, and a primitive's place in
// that row is its slot.

struct Sphere {
    Real3 center;
    Real radius;
};

struct Box {
    Real3 center;
    Real size;      // the largest half size
    Real3 axis_x;   // + axis_x_error: unit, kernel frame
    Real half_x;
    Real3 axis_y;
    Real half_y;
    Real3 axis_z;
    Real half_z;
    Real3 axis_x_error;
    Real unused_0;
    Real3 axis_y_error;
    Real unused_1;
    Real3 axis_z_error;
    Real unused_2;
};

struct Cylinder {
    Real3 center;       // + center_error: between the ends
    Real radius;
    Real3 center_error;
    Real half_length;
    Real3 axis;         // + axis_error: unit, from the first end to the second
    Real size;          // the larger of radius and half length
    Real3 axis_error;
    Real reach;         // of the bounding sphere about the centre
};

struct Cone {
    Real3 apex;
    Real height;
    Real3 axis;         // + axis_error: unit, from the apex to the base
    Real size;          // the larger of height and base radius
    Real3 axis_error;
    Real reach;         // of the bounding sphere about the apex
    Real sine;          // of the half-angle
    Real cosine;
    Real unused_0;
    Real unused_1;
};

struct Material {
    Real3 color;          // linear RGB
    Real ambient;
    Real diffuse;
    Real specular;
    Real primitive;       // index in the scene
    Real unused;
};

struct Light {
    Real3 position;
    Real ball_radius;
    Real3 intensity;      // linear RGB
    Real unused;
};

struct View {
    Real3 left;           // unit vectors of the camera, kernel frame
    Real half_width;      // of the centred window in the plane at distance 1
    Real3 up;
    Real half_height;
    Real3 ahead;
    Real window_low;      // -1: the course's window [-3,1]^2; 0: the centred window [-1,1]^2
    Real3 background;     // linear RGB
    Real unused;
};

layout(binding = 1, std430) readonly buffer ViewAndLights { View view; Light lights[]; };
// By slot: a sphere around the primitive, with a radius rounded up.
layout(binding = 2, std430) readonly buffer Bounds { Real4 bounds[]; };
layout(binding = 3, std430) readonly buffer Spheres { Sphere spheres[]; };
layout(binding = 4, std430) readonly buffer Boxes { Box boxes[]; };
layout(binding = 5, std430) readonly buffer Cylinders { Cylinder cylinders[]; };
layout(binding = 6, std430) readonly buffer Cones { Cone cones[]; };
// By slot.
layout(binding = 7, std430) readonly buffer Materials { Material materials[]; };

const uint SPHERE = 0u;
const uint BOX = 1u;
const uint CYLINDER = 2u;
const uint CONE = 3u;

// Kinds that are not there cost nothing.
layout(constant_id = 1) const bool HAS_SPHERES = true;
layout(constant_id = 2) const bool HAS_BOXES = true;
layout(constant_id = 3) const bool HAS_CYLINDERS = true;
layout(constant_id = 4) const bool HAS_CONES = true;
