// What the camera sees, pixel by pixel, row by row from the top: the light pass writes it, reflections are found in it.
// ACCESS: what a kernel does with it; RADIANCES: the binding of the first buffer.

// Linear RGB that comes from there without reflections. Alpha: the share of the mirrored ray, 0 where there is no solid;
// UNFINISHED of a pixel that did not come to its end.
layout(binding = RADIANCES, std430) ACCESS buffer Radiances { vec4 radiances[]; };
// Scene space.
layout(binding = 8, std430) ACCESS buffer Points { vec4 points[]; };
// Unit, towards the camera; last: the face, whether that is its inner side, and the lights that reach it.
layout(binding = 9, std430) ACCESS buffer Normals { uvec4 normals[]; };
// Nearness, 1 / (distance along the optical axis), of what is nearest and of what is farthest: of each pixel, then of
// 2x2 of them, and so on up to the whole picture. Along a ray it is linear on the screen. Of no solid it is 0. Of a pixel
// both are one: in place of the second stands the solid's slot, or NOTHING, which is no number that floats keep.
layout(binding = 10, std430) ACCESS buffer Depths { uvec2 depths[]; };

const float UNFINISHED = -1.0;
const uint INNER_SIDE_BIT = 4u; // above the faces
const uint FIRST_LIT_BIT = 5u;  // LIT_BITS of them

struct Side {
    uint face;
    bool is_inner;
    uint lit;
};

uint packed(Side side) { return side.face | uint(side.is_inner) << INNER_SIDE_BIT | side.lit << FIRST_LIT_BIT; }

Side side_of(uint packed) {
    return Side(bitfieldExtract(packed, 0, int(INNER_SIDE_BIT)), bitfieldExtract(packed, int(INNER_SIDE_BIT), 1) != 0u,
                packed >> FIRST_LIT_BIT);
}

uint place_of(uvec2 pixel) { return pixel.y * unpacked(frame.image_size).x + pixel.x; }
