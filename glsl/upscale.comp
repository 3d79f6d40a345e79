#version 460
// A picture traced at a smaller size, brought to the size asked for: bilinear between the centres of the traced pixels;
// beyond the outermost of them the picture goes on as it is there.
//
// Bilinear, since it keeps every colour between those it comes from: filters that are sharper overshoot, and beside a
// highlight far above 1 that is a black rim.
layout(local_size_x_id = 0, local_size_y_id = 1) in;

layout(binding = 0, rgba32f) uniform writeonly image2D picture; // one tile, linear RGB; alpha as in the traced one
layout(binding = 1, rgba32f) uniform readonly image2D traced;   // what that tile needs of the smaller picture

// `UpscalePushConstants` of src/tracer/upscale.rs; pixels.
layout(push_constant, std430) uniform Push {
    uvec2 size;          // of the whole picture
    uvec2 traced_size;   // of the whole smaller one
    uvec2 origin;        // of the tile
    uvec2 traced_origin; // of what it needs
} frame;

vec4 traced_pixel(ivec2 pixel) { return imageLoad(traced, pixel - ivec2(frame.traced_origin)); }

vec3 between(vec3 low, vec3 high, float share) {
    precise vec3 result = low + (high - low) * share;
    return result;
}

void main() {
    uvec2 tile_pixel = gl_GlobalInvocationID.xy;
    uvec2 pixel = frame.origin + tile_pixel;
    bool is_there = all(lessThan(tile_pixel, uvec2(imageSize(picture)))) && all(lessThan(pixel, frame.size));
    if (!is_there) return;

    // Where the pixel's centre lies among the centres of the traced ones, times twice the size: whole numbers below
    // 2^30, so that a pixel has the same neighbours in every tile and on every device, and its share is one quotient.
    ivec2 unit = ivec2(2u * frame.size);
    ivec2 last = ivec2(frame.traced_size) - 1;
    ivec2 place = ivec2((2u * pixel + 1u) * frame.traced_size) - ivec2(frame.size);
    place = clamp(place, ivec2(0), last * unit);
    ivec2 low = place / unit;
    ivec2 high = min(low + 1, last);
    vec2 share = vec2(place - low * unit) / vec2(unit);

    vec4 top_left = traced_pixel(low), top_right = traced_pixel(ivec2(high.x, low.y));
    vec4 bottom_left = traced_pixel(ivec2(low.x, high.y)), bottom_right = traced_pixel(high);
    vec3 top = between(top_left.rgb, top_right.rgb, share.x);
    vec3 bottom = between(bottom_left.rgb, bottom_right.rgb, share.x);
    float ended = min(min(top_left.a, top_right.a), min(bottom_left.a, bottom_right.a));
    imageStore(picture, ivec2(tile_pixel), vec4(between(top, bottom, share.y), ended));
}
