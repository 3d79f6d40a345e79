#version 460
#extension GL_GOOGLE_include_directive : require
// The course work's kernel: listings B.1-B.4 of its note, one file a listing, kept as printed
// (names, order, constants, even what is unused). All that differs from the listings, and why:
//
//  1. The uniform arrays are uniform buffers, the light and the counts push constants; so `findIntersection` no
//     longer takes arrays, which GLSL passes by value.
//  2. `findIntersection` takes the caller's previous `Intersection`, and a miss keeps its fields (with t = INF). The
//     listing leaves them undefined; this is what the published pictures show.
//  3. `calculateReflected` and the primary ray, missing from the listings, are in rays.glsl.
//  4. The shadowed branch of B.3 reflects the ray as well: the transcription lost that line.
//  5. MAX_DEPTH is a specialization constant; the loop of B.3 also ends at `frame.depth`, so that fewer generations
//     need no new pipeline.
//  6. The background of B.3 is `frame.background` (the listing's constant is the scene format's default).
//  7. The order of rounding is written down as the goldens have it (rounding.glsl; tested on lavapipe alone): `dot`,
//     `normalize`, `reflect` and `length` are redefined, and B.2 turns into a box's frame by `rotate(m, v)` for m * v.
//  8. The line breaks and indents that the transcription lost are restored.
#include "course/interface.glsl"

layout(constant_id = 0) const int MAX_DEPTH = 20;
layout(local_size_x_id = 1, local_size_y_id = 2) in;

#include "course/bindings.glsl"
#include "course/types.glsl"
#include "course/rounding.glsl"
#include "course/rays.glsl"
#include "course/phong.glsl"
#include "course/intersections.glsl"
#include "course/find_intersection.glsl"
#include "course/ray_trace.glsl"

void main() {
    uvec2 tile_pixel = gl_GlobalInvocationID.xy;
    uvec2 pixel = uvec2(frame.tile_origin & 0xFFFFu, frame.tile_origin >> 16) + tile_pixel;
    uvec2 size = uvec2(frame.image_size & 0xFFFFu, frame.image_size >> 16);
    // The last workgroups of a tile and the last tiles of a picture reach past its edge.
    if (any(greaterThanEqual(tile_pixel, uvec2(imageSize(picture)))) || any(greaterThanEqual(pixel, size))) return;

    vec2 point = windowPoint(uvec2(pixel.x, size.y - 1u - pixel.y), size);
    float aspect = float(size.x) / float(size.y);
    vec4 color = RayTrace(primaryRay(point, aspect), frame.lens);
    imageStore(picture, ivec2(tile_pixel), vec4(color.rgb, 1.0));
}
