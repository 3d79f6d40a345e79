#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// The accurate kernel (DESIGN.md, "The accurate model"; NUMERICS.md): one source for float and double.
layout(local_size_x_id = 5, local_size_y_id = 6) in;

#include "whitted/solids.glsl"
#include "whitted/search.glsl"
#include "whitted/shade.glsl"
#include "whitted/trace.glsl"

layout(binding = 0, rgba32f) uniform image2D picture; // one tile, linear RGB; alpha: samples that came to their end

// A pixel's colour is the mean of several samples, each added by a run of its own; see src/tracer/sampling.rs.
layout(constant_id = 18) const bool HAS_SAMPLES = false;
// Of a pixel, along each side.
const uint SUBPIXELS = 65u;

void main() {
    // Eight invocations in a row take four pixels by two, which see more of the same than eight in a row.
    uvec2 place = gl_LocalInvocationID.xy;
    bool is_square = gl_WorkGroupSize.x == 8u && gl_WorkGroupSize.y % 2u == 0u;
    place = is_square ? uvec2((place.x & 3u) | (place.y & 1u) << 2, (place.y & ~1u) | place.x >> 2) : place;
    uvec2 tile_pixel = gl_WorkGroupID.xy * gl_WorkGroupSize.xy + place;
    uvec2 pixel = uvec2(frame.tile_origin & 0xFFFFu, frame.tile_origin >> 16) + tile_pixel;
    uvec2 size = uvec2(frame.image_size & 0xFFFFu, frame.image_size >> 16);
    // The last workgroups of a tile and the last tiles of a picture reach past its edge. Packets are of whole rows of
    // invocations, so none may leave before the others.
    bool is_there = all(lessThan(tile_pixel, uvec2(imageSize(picture)))) && all(lessThan(pixel, size));

    View view = view();
    // A sample's ray is that of a pixel of a picture that is SUBPIXELS times as wide and high.
    uvec2 fine_pixel = HAS_SAMPLES ? SUBPIXELS * pixel + frame.sample_place : pixel;
    Ray ray = primary_ray(fine_pixel, HAS_SAMPLES ? SUBPIXELS * size : size, view);
    Real3 color = trace(ray, is_there, view.background);
    if (!is_there) return;
    vec3 shown = vec3(min(color, Real3(3.4028234663852886e38)));
    if (frame.writes_remainder != 0u) shown = vec3(min(color - Real3(shown), Real3(3.4028234663852886e38)));
    float ended = turns < LOOP_TURNS ? 1.0 : 0.0;
    if (HAS_SAMPLES && frame.samples_before > 0u) {
        vec4 before = imageLoad(picture, ivec2(tile_pixel));
        precise vec3 mean = before.rgb + (shown - before.rgb) * frame.sample_weight;
        shown = mean;
        ended += before.a;
    }
    imageStore(picture, ivec2(tile_pixel), vec4(shown, ended));
}
