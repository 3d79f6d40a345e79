// The scene as it lies in memory: rows of four reals, so that the layout is the same for float and double.
// src/tracer/whitted/records.rs writes them.
//
// Scene space: the world frame with its origin among the solids, times a power of two that brings the farthest
// coordinate of a solid, and of the camera, below 2. Within a kind the solids lie in the order of its hierarchy; the
// kinds lie behind each other, and a primitive's index in that row is its slot.

// Solids are given relative to an anchor: their centre, in a close-up their point nearest to the camera; cones, their
// apex.

// A round surface about an anchor, in a close-up: offset + slope . x + |x|^2 / (2 * radius) = 0.
struct Curve {
    Real3 slope;          // + slope_error: from the centre, or the axis, to the anchor, in radii
    Real offset;
    Real3 slope_error;
};

struct Sphere {
    Real3 anchor;
    Real radius;
    Curve curve;
};

struct Box {
    Real3 anchor;
    Real size;            // the largest half size
    Real3 high;           // positions of the upper faces along the axes, from the anchor
    Real3 low;            // and of the lower ones
    Real3 axis_x;         // + axis_x_error: unit, scene space
    Real3 axis_y;
    Real3 axis_z;
    Real3 axis_x_error;
    Real3 axis_y_error;
    Real3 axis_z_error;
};

struct Cylinder {
    Real3 anchor;         // + anchor_error
    Real radius;
    Real3 anchor_error;
    Real high;            // position of the second end along the axis, from the anchor
    Real low;             // and of the first
    Real3 axis;           // + axis_error: unit, from the first end to the second
    Real size;            // the larger of radius and half length; in a close-up of radius and length
    Real3 axis_error;
    Real reach;           // of the bounding sphere about the anchor
    Curve curve;          // across the axis
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
};

struct Material {
    Real3 color;          // linear RGB
    Real ambient;
    Real diffuse;
    Real specular;
    Real reflection;      // weight of the mirrored ray
    uint primitive;       // index in the scene
    uint shininess_256;   // the highlight's exponent, times 256
    Real transmission;    // weight of the refracted ray
    Real refractive_index; // 0 of a plate without thickness, which rays go through as they are
};

struct Light {
    Real3 position;
    Real sphere_radius;
    Real3 intensity;      // linear RGB
    // What reaches a point at distance d is intensity * scale / (slope * d + constant).
    Real scale;
    Real slope;
    Real constant;
};

struct View {
    Real3 left;           // unit vectors of the camera, scene space
    Real half_width;      // of the centred window in the plane at distance 1
    Real3 up;
    Real half_height;
    Real3 ahead;
    Real window_low;      // -1: the course's window [-3,1]^2; 0: the centred window [-1,1]^2
    Real3 background;     // linear RGB
    Real3 position;       // + position_error: of the camera
    Real3 position_error;
    bool may_be_in_medium; // the camera
    Real3 ambient_light;  // linear RGB
};

// What a scene lacks costs nothing: the pipeline is made for what there is.
layout(constant_id = 1) const bool HAS_SPHERES = true;
layout(constant_id = 2) const bool HAS_BOXES = true;
layout(constant_id = 3) const bool HAS_CYLINDERS = true;
layout(constant_id = 4) const bool HAS_CONES = true;
const bool IS_ONLY_KIND = int(HAS_SPHERES) + int(HAS_BOXES) + int(HAS_CYLINDERS) + int(HAS_CONES) == 1;
layout(constant_id = 8) const bool ARE_BOXES_AXIS_ALIGNED = false;
layout(constant_id = 9) const uint SPHERE_LEVELS = 0u;
layout(constant_id = 10) const uint BOX_LEVELS = 0u;
layout(constant_id = 11) const uint CYLINDER_LEVELS = 0u;
layout(constant_id = 12) const uint CONE_LEVELS = 0u;
// A close-up, of solids beside which the way to the camera is short: the frame's origin is the camera, and anchors are
// the points of spheres, boxes and axes nearest to it, so that the rounding error scales with the distance of things,
// not with the solid's size.
layout(constant_id = 20) const bool IS_CLOSE_UP = false;
// What there is not, or the plan has left out.
layout(constant_id = 13) const bool HAS_HIGHLIGHTS = true;
layout(constant_id = 14) const uint LIGHTS = 2u; // none, one, several, or many (3)
layout(constant_id = 15) const bool HAS_SHADOWS = true;
const bool CHOOSES_LIGHT = LIGHTS == 3u && HAS_SHADOWS; // a hit's shadow ray goes to one of many
layout(constant_id = 16) const bool HAS_REFLECTIONS = true;
layout(constant_id = 17) const uint LIGHT_SPHERES = 2u; // of lights, that primary rays may see: as many
layout(constant_id = 21) const bool HAS_SHININESS = false;    // highlights of other exponents than 5
layout(constant_id = 22) const bool HAS_ATTENUATION = false;
layout(constant_id = 23) const bool HAS_AMBIENT_LIGHT = false; // other than white of 1
// What lets light through: nothing, solids that lie apart, or such as may touch others or hold the camera.
layout(constant_id = 24) const uint MEDIA = 0u;
const uint NO_MEDIA = 0u;
const uint APART = 1u;
const uint NESTED = 2u;

// Mesa's CPU drivers cut an invocation's loops short, without a word, after 65535 iterations of all of them together:
// there the search ends before that, and says so. 0: without limit, and then nothing is compared. With the greatest
// number instead, RADV of Mesa 25 compiled a scene without solids endlessly.
layout(constant_id = 7) const uint MAX_ITERATIONS = 0u;
uint iterations = 0u;
bool has_run_out() { return MAX_ITERATIONS > 0u && iterations >= MAX_ITERATIONS; }

// Rows come through texel buffers: a CPU driver fetches a row for eight invocations at once there, and goes from one to
// the next to read a storage buffer.
layout(binding = 1) uniform Rows view_and_lights;
// What finds candidates, by kind; see hierarchy.glsl.
layout(binding = 2) uniform samplerBuffer proxies;
layout(binding = 3) uniform Rows sphere_rows;
layout(binding = 4) uniform Rows box_rows;
layout(binding = 5) uniform Rows cylinder_rows;
layout(binding = 6) uniform Rows cone_rows;
// By slot.
layout(binding = 7) uniform Rows material_rows;

View view() {
    Real4 a = ROW(view_and_lights, 0u), b = ROW(view_and_lights, 1u);
    Real4 c = ROW(view_and_lights, 2u), d = ROW(view_and_lights, 3u);
    Real4 e = ROW(view_and_lights, 4u), f = ROW(view_and_lights, 5u);
    Real3 ambient_light = Real3(1.0);
    if (HAS_AMBIENT_LIGHT) ambient_light = ROW(view_and_lights, 6u).xyz;
    return View(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, d.xyz, e.xyz, f.xyz, e.w != 0.0, ambient_light);
}

// A packet holds what all its rays read time and again, once `hold` in search.glsl has read it. A ray that goes for itself
// reads it anew: a GPU has as many rays under way as there are registers for.
View held_view;

View view_at_hand() {
    View at_hand = held_view;
    if (!IN_PACKETS) at_hand = view();
    return at_hand;
}

Light light(uint index) {
    uint first = 7u + (HAS_ATTENUATION ? 3u : 2u) * index;
    Real4 a = ROW(view_and_lights, first), b = ROW(view_and_lights, first + 1u), c = Real4(1.0, 0.0, 1.0, 0.0);
    if (HAS_ATTENUATION) c = ROW(view_and_lights, first + 2u);
    return Light(a.xyz, a.w, b.xyz, c.x, c.y, c.z);
}

Material material(uint slot) {
    const bool has_optics = HAS_SHININESS || MEDIA != NO_MEDIA;
    uint first = (has_optics ? 3u : 2u) * slot;
    Real4 a = ROW(material_rows, first), b = ROW(material_rows, first + 1u), c = Real4(0.0);
    if (has_optics) c = ROW(material_rows, first + 2u);
    return Material(a.xyz, a.w, b.x, b.y, b.w, uint(b.z), uint(c.x), c.y, c.z);
}

const Curve NO_CURVE = Curve(Real3(0.0), Real(0.0), Real3(0.0));

// The solids of a kind are counted by themselves.
Sphere sphere(uint index) {
    if (IS_CLOSE_UP) {
        Real4 a = ROW(sphere_rows, 3u * index), b = ROW(sphere_rows, 3u * index + 1u);
        return Sphere(a.xyz, a.w, Curve(b.xyz, b.w, ROW(sphere_rows, 3u * index + 2u).xyz));
    }
    Real4 a = ROW(sphere_rows, index);
    return Sphere(a.xyz, a.w, NO_CURVE);
}

Box box(uint index) {
    uint first = 7u * index;
    Box box;
    Real4 a = ROW(box_rows, first);
    box.anchor = a.xyz;
    box.size = a.w;
    Real4 x = ROW(box_rows, first + 1u), y = ROW(box_rows, first + 2u), z = ROW(box_rows, first + 3u);
    box.high = Real3(x.w, y.w, z.w);
    box.low = -box.high;
    if (IS_CLOSE_UP)
        box.low = Real3(ROW(box_rows, first + 4u).w, ROW(box_rows, first + 5u).w, ROW(box_rows, first + 6u).w);
    box.axis_x = ARE_BOXES_AXIS_ALIGNED ? Real3(1.0, 0.0, 0.0) : x.xyz;
    box.axis_y = ARE_BOXES_AXIS_ALIGNED ? Real3(0.0, 1.0, 0.0) : y.xyz;
    box.axis_z = ARE_BOXES_AXIS_ALIGNED ? Real3(0.0, 0.0, 1.0) : z.xyz;
    box.axis_x_error = ARE_BOXES_AXIS_ALIGNED ? Real3(0.0) : ROW(box_rows, first + 4u).xyz;
    box.axis_y_error = ARE_BOXES_AXIS_ALIGNED ? Real3(0.0) : ROW(box_rows, first + 5u).xyz;
    box.axis_z_error = ARE_BOXES_AXIS_ALIGNED ? Real3(0.0) : ROW(box_rows, first + 6u).xyz;
    return box;
}

Cylinder cylinder(uint index) {
    uint first = (IS_CLOSE_UP ? 5u : 4u) * index;
    Real4 a = ROW(cylinder_rows, first), b = ROW(cylinder_rows, first + 1u);
    Real4 c = ROW(cylinder_rows, first + 2u), d = ROW(cylinder_rows, first + 3u);
    if (IS_CLOSE_UP) {
        Real4 e = ROW(cylinder_rows, first + 4u);
        Real size = max(a.w, b.w - c.w);
        return Cylinder(a.xyz, a.w, Real3(0.0), b.w, c.w, c.xyz, size, d.xyz, d.w, Curve(b.xyz, e.w, e.xyz));
    }
    return Cylinder(a.xyz, a.w, b.xyz, b.w, -b.w, c.xyz, c.w, d.xyz, d.w, NO_CURVE);
}

Cone cone(uint index) {
    uint first = 4u * index;
    Real4 a = ROW(cone_rows, first), b = ROW(cone_rows, first + 1u);
    Real4 c = ROW(cone_rows, first + 2u), d = ROW(cone_rows, first + 3u);
    return Cone(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, d.x, d.y);
}
