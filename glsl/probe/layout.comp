#version 460
#extension GL_GOOGLE_include_directive : require
// Writes every field of every record it is given, one float a component, in the order of the declarations: the test
// gives each its own value and so proves that host and kernel mean the same bytes.
#include "course/interface.glsl"
layout(local_size_x = 1) in;
#include "course/bindings.glsl"
layout(binding = 5, std430) buffer Echo { float echo[]; };

int next = 0;
void put(float value) { echo[next++] = value; }
void put(vec3 value) { put(value.x); put(value.y); put(value.z); }
void put(Material material) { put(material.color); put(material.lightKoefs); }

void main() {
    for (int i = 0; i < MAX_PRIMITIVES; i++) {
        put(spheres[i].center); put(spheres[i].radius); put(spheres[i].material);
    }
    for (int i = 0; i < MAX_PRIMITIVES; i++) {
        put(boxes[i].position); put(boxes[i].halfSize);
        for (int column = 0; column < 3; column++) put(boxes[i].rotation[column]);
        put(boxes[i].material);
    }
    for (int i = 0; i < MAX_PRIMITIVES; i++) {
        put(cylinders[i].extr_a); put(cylinders[i].extr_b); put(cylinders[i].ra); put(cylinders[i].material);
    }
    for (int i = 0; i < MAX_PRIMITIVES; i++) {
        put(cones[i].c); put(cones[i].cosa); put(cones[i].v); put(cones[i].h); put(cones[i].material);
    }
    put(frame.camera_position); put(float(frame.tile_origin));
    put(frame.camera_s); put(float(frame.image_size));
    put(frame.camera_u); put(float(frame.depth));
    put(frame.camera_f); put(frame.window_low);
    put(frame.light.position); put(frame.light.intensivity);
    put(frame.background);
    put(float(frame.lens.size_spheres)); put(float(frame.lens.size_boxes));
    put(float(frame.lens.size_cylinders)); put(float(frame.lens.size_cones));
    put(frame.half_fov_tangent);
}
