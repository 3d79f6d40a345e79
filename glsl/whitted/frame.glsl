// The push constants; `WhittedFrame` of src/tracer/whitted_records.rs.
struct WhittedFrame {
    uvec4 counts;     // of spheres, boxes, cylinders, cones
    uint tile_origin; // pixels, x | y << 16
    uint image_size;  // pixels, width | height << 16
    uint depth;       // generations to trace
    uint light_count;
    uint writes_remainder; // not 0: what the colour loses by rounding to float, instead of the colour
    float least_weight;    // a path ends as soon as it weighs no more than that; below 1
    float least_shadowed;  // of light that is no more than that, times the path's weight, half counts, in shadow or not
};
layout(push_constant, std430) uniform Push { WhittedFrame frame; };

// All primitives of the scene.
Ranges whole_scene() {
    uvec4 counts = frame.counts;
    uvec4 first_slot = uvec4(0u, counts.x, counts.x + counts.y, counts.x + counts.y + counts.z);
    return Ranges(uvec4(0u), counts, first_slot);
}
