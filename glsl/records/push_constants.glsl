// The push constants; `WhittedPushConstants` of src/tracer/whitted/records.rs.
struct WhittedPushConstants {
    uvec4 counts;     // of spheres, boxes, cylinders, cones
    uvec4 proxies;   // where their proxies begin, rows
    uint tile_origin; // pixels, x | y << 16
    uint image_size;  // pixels, width | height << 16
    uint depth;       // generations to trace
    uint light_count;   // of lights that give any light; they come first
    float reach;      // half of the largest coordinate of a solid or of a ray's origin
    uint writes_remainder; // not 0: what the colour loses by rounding to float, instead of the colour
    float min_throughput;    // a path ends as soon as it weighs no more than that; below 1
    float min_shadowed;  // of light that is no more than that, times the path's weight, half counts, in shadow or not
    uvec2 sample_place;    // in the pixel, sub-pixels from its top left
    uint samples_before;   // of each pixel, that the picture is the mean of
    float sample_weight;   // of this run in the mean: its samples' share
    uint tile_size;        // pixels, width | height << 16
    uint light_sphere_count; // of all lights
    uint seed;             // of the random numbers of path tracing
    uint samples_at_once;  // of a pixel in a run of it
};
layout(push_constant, std430) uniform Push { WhittedPushConstants pushed; };

// Read once: within a loop a CPU driver would fetch a number for each invocation by itself, turn after turn.
WhittedPushConstants frame = pushed;

// First slot of each kind, which takes whole groups of eight.
uvec4 first_slots() {
    uvec4 counts = frame.counts + 7u & ~7u;
    return uvec4(0u, counts.x, counts.x + counts.y, counts.x + counts.y + counts.z);
}
