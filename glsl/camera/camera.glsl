// The pixels of a tile, and what the camera sends through them.

// An invocation traces so many pixels, one after another: PIXELS workgroups lie below each other in one.
layout(constant_id = 19) const uint PIXELS = 1u;

// A pixel's colour is the mean of several samples, each added by a run of its own; see src/tracer/sampling.rs.
layout(constant_id = 18) const bool HAS_SAMPLES = false;
// Sub-pixels of a pixel, along each side.
const uint SUBPIXELS = 65u;

// Two numbers below 2^16.
uvec2 unpacked(uint packed) { return uvec2(packed & 0xFFFFu, packed >> 16); }

// In the tile: the invocation's pixel with this index.
uvec2 tile_pixel(uint index) {
    // Eight invocations in a row take four pixels by two, which see more of the same than eight in a row.
    uvec2 place = gl_LocalInvocationID.xy;
    bool is_square = gl_WorkGroupSize.x == 8u && gl_WorkGroupSize.y % 2u == 0u;
    place = is_square ? uvec2((place.x & 3u) | (place.y & 1u) << 2, (place.y & ~1u) | place.x >> 2) : place;
    // Columns of workgroups lie side by side along z: `Part::shares` of src/tracer/parts.rs.
    uint column = gl_WorkGroupID.x * gl_NumWorkGroups.z + gl_WorkGroupID.z;
    uvec2 workgroup = uvec2(column, PIXELS * gl_WorkGroupID.y + index);
    return workgroup * gl_WorkGroupSize.xy + place;
}

// The last workgroups of a tile reach past its edge.
bool is_there(uvec2 tile_pixel) { return all(lessThan(tile_pixel, unpacked(frame.tile_size))); }

// Through a place of the window: x right, y up, in [0, 1]^2, what the camera formula was written for. The course feeds it
// [-1, 1]^2. Of any length.
Real3 direction_through(Real x, Real y, View view) {
    bool is_course = view.window_low < 0.0;
    precise Real window_x = is_course ? 2.0 * x - 1.0 : x;
    precise Real window_y = is_course ? 2.0 * y - 1.0 : y;
    precise Real to_left = (1.0 - 2.0 * window_x) * view.half_width;
    precise Real upward = (2.0 * window_y - 1.0) * view.half_height;
    precise Real3 direction = view.left * to_left + view.up * upward + view.ahead;
    return direction;
}

// Through the centre of a pixel, or of its sample; of any length.
Real3 primary_direction(uvec2 tile_pixel, View view) {
    uvec2 pixel = unpacked(frame.tile_origin) + tile_pixel, size = unpacked(frame.image_size);
    // A sample's ray is that of a pixel of a picture that is SUBPIXELS times as wide and high.
    pixel = HAS_SAMPLES ? SUBPIXELS * pixel + frame.sample_place : pixel;
    size = HAS_SAMPLES ? SUBPIXELS * size : size;
    // Twice the pixel centre is a whole number: exact.
    precise Real x = Real(2u * pixel.x + 1u) / Real(2u * size.x);
    precise Real y = Real(2u * (size.y - 1u - pixel.y) + 1u) / Real(2u * size.y);
    return direction_through(x, y, view);
}

// Through a place in a pixel of the tile: x right, y up, in [0, 1]^2; of any length.
Real3 direction_within(uvec2 tile_pixel, Real2 place, View view) {
    uvec2 pixel = unpacked(frame.tile_origin) + tile_pixel, size = unpacked(frame.image_size);
    Real2 from_low = Real2(pixel.x, size.y - 1u - pixel.y) + place;
    return direction_through(from_low.x / Real(size.x), from_low.y / Real(size.y), view);
}
