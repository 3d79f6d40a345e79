// A ray's way over the screen, through the depth pyramid, past all solids that it may meet where the camera sees them.
//
// A point at ray parameter t, at distance z(t) along the optical axis, is seen at start + x * slope, with x = t / z(t);
// its nearness 1 / z(t) is linear in x, too.

// How a march has come to its end.
const uint UNDER_WAY = 0u;
const uint AT_ITS_END = 1u; // infinitely far away, or at what it meets
const uint OFF_SCREEN = 2u;

struct March {
    vec2 start;          // pixels from the picture's top left
    vec2 slope;
    vec2 inverse_slope;
    vec2 far_edges;      // of a cell, in cells: 1 where it goes that way
    vec2 nudged_start;   // where it is looked up
    float nearness;      // at the start
    float nearness_slope;
    float at;            // x of the above, so far
    float end;           // at x, of what is met or infinitely far away
    uint steps_left;
    uint level;          // of the pyramid
    uint top_level;
    uint first;          // where that begins
    uint own;            // slot that it cannot meet
    uint tested;         // slot that was a candidate last
    uint candidate;      // slot to be solved, or NOTHING ...
    uvec2 pixel;         // ... and where it is seen
    uint ending;
    bool is_behind;      // something that the camera sees, where it is now
    bool has_passed;     // behind something
};

// Pixels, so much ahead a ray is looked up, so that it is in the next cell where it comes to its edge. Above the rounding
// of positions: 2^-10 in a picture of 16384.
const float NUDGE = 1.0 / 128.0;

// The point relative to the camera, on the screen: pixels times the distance along the optical axis, and that.
vec3 on_screen(vec3 from_camera, View view) {
    vec2 size = vec2(unpacked(frame.image_size));
    float ahead = dot(from_camera, view.ahead);
    vec2 aside = vec2(dot(from_camera, view.left) / view.half_width, -dot(from_camera, view.up) / view.half_height);
    // In the centred window, [0, 1]^2 from the top left; the course's shows twice that, and begins a width to the left.
    vec2 window = 0.5 * (vec2(ahead) + vec2(-aside.x, aside.y));
    bool is_course = view.window_low < 0.0;
    if (is_course) window = 0.5 * window + vec2(0.5 * ahead, 0.0);
    return vec3(size * window, ahead);
}

// For a ray from a point that the camera sees; `is_there` else it is at its end.
March march_along(Ray ray, OriginSurface origin_surface, View view, bool is_there) {
    vec3 start = on_screen(ray.origin - view.position, view), slope = on_screen(ray.direction, view);
    March march;
    march.nearness = 1.0 / start.z;
    march.start = start.xy * march.nearness;
    march.slope = slope.xy - march.start * slope.z;
    march.inverse_slope = mix(1.0 / march.slope, vec2(LARGEST), equal(march.slope, vec2(0.0)));
    march.far_edges = step(0.0, march.slope);
    march.nudged_start = march.start + NUDGE * sign(march.slope);
    march.nearness_slope = -march.nearness * slope.z;
    march.at = 0.0;
    march.end = slope.z > 0.0 ? 1.0 / slope.z : LARGEST;
    // Each step that is not down a level crosses an edge of a pixel, and for each down there is one up. Twice that, as
    // rounding may cost a step here and there.
    uvec2 picture = unpacked(frame.image_size);
    march.steps_left = 4u * (picture.x + picture.y) + 64u;
    march.level = 0u;
    march.top_level = uint(findMSB(max(picture.x, picture.y) - 1u) + 1);
    march.first = 0u;
    march.own = origin_surface.inside ? NOTHING : origin_surface.slot;
    march.tested = NOTHING;
    march.candidate = NOTHING;
    march.pixel = uvec2(0u);
    march.ending = is_there ? UNDER_WAY : AT_ITS_END;
    march.is_behind = false;
    march.has_passed = false;
    return march;
}

float nearness_at(March march, float x) { return max(march.nearness + x * march.nearness_slope, 0.0); }

vec2 place_at(March march, float x) { return march.start + x * march.slope; }

// Where a ray is at a parameter; LARGEST behind the camera.
float screen_parameter(March march, float t) {
    float start = 1.0 / march.nearness, slope = -march.nearness_slope / march.nearness;
    float ahead = start + t * slope;
    return ahead > 0.0 ? t / ahead : LARGEST;
}

uvec2 level_size(uint level) { return (unpacked(frame.image_size) + ((1u << level) - 1u)) >> level; }

uint level_area(uint level) {
    uvec2 size = level_size(level);
    return size.x * size.y;
}

// To the edge of a cell, or down to a finer one; up to a pixel whose solid the ray may meet.
void step_on(inout March march) {
    float side = float(1u << march.level);
    ivec2 cell = ivec2(floor((march.nudged_start + march.at * march.slope) / side));
    uvec2 size = level_size(march.level);
    bool is_on_screen = all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, ivec2(size)));
    march.steps_left--;

    vec2 exits = ((vec2(cell) + march.far_edges) * side - march.start) * march.inverse_slope;
    float leave = max(min(min(exits.x, exits.y), march.end), march.at);
    float here = nearness_at(march, march.at), there = nearness_at(march, leave);

    uvec2 inside = uvec2(clamp(cell, ivec2(0), ivec2(size) - 1));
    bool is_pixel = march.level == 0u;
    uvec2 depth = depths[march.first + inside.y * size.x + inside.x];
    uint slot = depth.y;
    vec2 seen = uintBitsToFloat(is_pixel ? depth.xx : depth);
    bool is_in_front = min(here, there) >= seen.x;
    bool is_hidden = march.is_behind && max(here, there) < seen.y;
    bool is_skipped = is_in_front || is_hidden;
    if (!is_on_screen || march.steps_left == 0u) {
        march.ending = OFF_SCREEN;
    } else if (is_skipped || is_pixel) {
        bool is_behind = is_hidden;
        if (!is_skipped) {
            bool is_other = slot != march.own && slot != NOTHING;
            if (is_other && slot != march.tested) {
                march.candidate = slot;
                march.pixel = inside;
                march.tested = slot;
            }
            is_behind = is_other && there < seen.x;
        }
        march.is_behind = is_behind;
        march.has_passed = march.has_passed || is_behind;
        march.at = leave;
        if (leave >= march.end) march.ending = AT_ITS_END;
        if (is_skipped && march.level < march.top_level) {
            march.first += size.x * size.y;
            march.level++;
        }
    } else {
        march.level--;
        march.first -= level_area(march.level);
    }
}

// Nothing beyond this is of interest: something is met there.
void end_at(float x, inout March march) {
    march.end = x;
    if (march.at >= x) march.ending = AT_ITS_END;
}
