#version 460
// Screen-space reflections, second pass: the next level of the depth pyramid, the nearest and the farthest of 2x2.
layout(local_size_x_id = 0, local_size_y_id = 1) in;

layout(binding = 0, std430) buffer Depths { uvec2 depths[]; }; // of `ssr/surfaces.glsl`, one level behind the other

// `DepthsPushConstants` of src/tracer/ssr/passes.rs.
layout(push_constant, std430) uniform Push {
    uvec2 size;      // of the finer level
    uint first;      // where it begins
    uint next_first; // where the coarser one does
} frame;

// The nearest and the farthest of a cell; of a pixel, both are one.
vec2 seen(uint place) {
    uvec2 depth = depths[place];
    return uintBitsToFloat(frame.first == 0u ? depth.xx : depth);
}

void main() {
    uvec2 cell = gl_GlobalInvocationID.xy, next_size = (frame.size + 1u) / 2u;
    if (any(greaterThanEqual(cell, next_size))) return;
    // The last of an odd number stands alone.
    uvec2 low = 2u * cell, high = min(low + 1u, frame.size - 1u);
    uint top = frame.first + low.y * frame.size.x, bottom = frame.first + high.y * frame.size.x;
    vec2 a = seen(top + low.x), b = seen(top + high.x), c = seen(bottom + low.x), d = seen(bottom + high.x);
    float nearest = max(max(a.x, b.x), max(c.x, d.x)), farthest = min(min(a.y, b.y), min(c.y, d.y));
    depths[frame.next_first + cell.y * next_size.x + cell.x] = floatBitsToUint(vec2(nearest, farthest));
}
