// What host and kernels share: bindings, records, push constants.
// src/tracer/course/records.rs mirrors every struct; glsl/probe/layout.comp echoes them so that a test proves both
// alike.

// The course work's limit over all kinds together; every array has room for one kind taking it whole.
// The largest array, 100 boxes of 112 B, stays under the 16 KiB of uniform buffer that every Vulkan device offers.
const int MAX_PRIMITIVES = 100;

struct Material {
    vec3 color;      // linear RGB
    vec3 lightKoefs; // k_a, k_d, k_s
};

struct Sphere {
    vec3 center;
    float radius;
    Material material;
};

struct Box {
    vec3 position; // of the centre
    vec3 halfSize;
    mat3 rotation; // box_from_world
    Material material;
};

struct Cylinder {
    vec3 extr_a; // centres of the bases
    vec3 extr_b;
    float ra;
    Material material;
};

struct Cone {
    vec3 c; // apex
    float cosa;
    vec3 v; // unit axis, from the apex to the base
    float h;
    Material material;
};

struct LightSource {
    vec3 position;
    vec3 intensivity; // linear RGB
};

struct PrimitiveArrLens {
    int size_spheres;
    int size_boxes;
    int size_cylinders;
    int size_cones;
};

// 128 B: the least any Vulkan device offers.
struct Frame {
    vec3 camera_position;
    uint tile_origin; // pixels, x | y << 16
    vec3 camera_s;    // unit, to the picture's LEFT
    uint image_size;  // pixels, width | height << 16
    vec3 camera_u;    // unit, up
    int depth;        // generations to trace, at most MAX_DEPTH
    vec3 camera_f;    // unit, against the viewing direction
    float window_low; // -1: the course's window [-3,1]²; 0: the centred window [-1,1]²
    LightSource light;
    vec3 background;  // linear RGB
    PrimitiveArrLens lens;
    float half_fov_tangent; // of the vertical field of view
};
