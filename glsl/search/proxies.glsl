// The proxies of solids: where a ray may meet one at the earliest, and whether it does for sure. In float, on the safe
// side; src/tracer/whitted/proxies.rs writes them. A proxy of nothing is never met.

// The half chord of a cylinder or a cone, squared, is off by this much of what it comes from: 2u for the difference, 3u
// for each dot product and 4u for the direction's length, each at most once, and as much again for the sum.
const float CHORD_ERROR = 32.0 * FLOAT_ROUNDOFF;
#if REAL_BITS == 64
// And by the rounding of centre and ray to float, at distances of up to 4 * frame.reach.
float chord_rounding() { return 64.0 * FLOAT_ROUNDOFF * frame.reach * frame.reach; }
#else
// The rounding of the camera is little against their place errors.
float chord_rounding() { return 0.0; }
#endif

// How near the line comes to a centre is off by so much of the distance D to that: u for the difference from the
// origin, 11u for how far ahead the closest point is (3u for the dot product, 8u for the direction's length), 2u for
// the way there and 2u for the squares. D is no more than that way and the radius; a proxy has the radius's part in it.
const float DISTANCE_ERROR = 16.0 * FLOAT_ROUNDOFF;

// Chord of a line in a sphere that is larger than the true one, by `error`, at most.
struct Chord {
    float ahead;        // its midpoint, from the ray's origin
    float radius;
    float half_squared; // negative where there is none
    float error;
};

Chord chord_of(vec4 a, TraversalRay traversal) {
    vec3 to_center = a.xyz - traversal.origin;
    float ahead = dot(to_center, traversal.direction);
    vec3 across = to_center - ahead * traversal.direction;
    float radius = a.w + DISTANCE_ERROR * abs(ahead);
    float error = DISTANCE_ERROR * (abs(ahead) + radius) + place_error();
    return Chord(ahead, radius, radius * radius - dot(across, across), error);
}

// a: centre, radius; larger by DISTANCE_ERROR times the radius and by a place error, for the rounding of the centre and
// the ray to float (7u * reach in position and as much by the direction, of the double kernel; of the float kernel the
// camera's 4u). Of a proxy of nothing, negative.
uint key_of_sphere(vec4 a, vec4 b, TraversalRay traversal, int entry, uint k) {
    Chord chord = chord_of(a, traversal);
    // Not a number where there is none.
    float half_chord = sqrt(chord.half_squared);
    float leaves = chord.ahead + (half_chord + 3.0 * place_error());
    int never = (floatBitsToInt(a.w) | floatBitsToInt(chord.half_squared) | floatBitsToInt(leaves)) >> 31;
    return key_of(chord.ahead - (half_chord + 3.0 * place_error()), never, entry, k);
}

void tighten_by_sphere(vec4 a, vec4 b, bool is_there, TraversalRay traversal, inout Found found) {
    Chord chord = chord_of(a, traversal);
    float half_chord = sqrt(max(chord.half_squared, 0.0));
    // Then the true half chord, squared, is no less than 0.77^2 of this one: radius and distance differ by five errors
    // at least, and truly by two less.
    bool is_deep = chord.half_squared >= 10.0 * chord.error * chord.radius;
    // The sine of the ray to the surface is half chord by radius; the origin is outside by t times that, or more.
    float rise = 0.77 * half_chord;
    bool is_ahead = (chord.ahead - half_chord) * rise > (HIDING_ERROR * 4.0 * frame.reach) * chord.radius;
    float latest = chord.ahead - rise + 3.0 * place_error();
    tighten(is_there && is_deep && is_ahead, latest, rise, chord.radius, traversal, found);
}

// a: centre; b: half sizes and, where the box is no more than its proxy, 1. Both rounded outwards by 2 place errors.
uint key_of_box(vec4 a, vec4 b, TraversalRay traversal, int entry, uint k) {
    vec3 middle = (a.xyz - traversal.origin) * traversal.inverse;
    vec3 reach = b.xyz * abs(traversal.inverse);
    ivec3 enters = floatBitsToInt(middle - reach), leaves = floatBitsToInt(middle + reach);
    int near = max(max(enters.x, enters.y), max(enters.z, entry));
    int far = min(min(leaves.x, leaves.y), leaves.z);
    return far < near ? 0xFFFFFFFFu : uint(near) & ~7u | k;
}

void tighten_by_box(vec4 a, vec4 b, bool is_there, TraversalRay traversal, inout Found found) {
    vec3 middle = (a.xyz - traversal.origin) * traversal.inverse;
    vec3 reach = b.xyz * abs(traversal.inverse);
    vec3 enters = middle - reach, leaves = middle + reach;
    float near = max(enters.x, max(enters.y, enters.z)), far = min(leaves.x, min(leaves.y, leaves.z));
    bool is_deep = b.w == 1.0 && near > traversal.plane_error && far - near > 2.0 * traversal.plane_error;
    // Smallest of three; one of them is right.
    vec3 slope = abs(traversal.direction);
    float sine = min(slope.x, min(slope.y, slope.z));
    tighten(is_there && is_deep, near + traversal.plane_error, sine, 1.0, traversal, found);
}

// A bounding sphere around the cylinder that encloses a solid: its centre, and the square of its radius, which is
// negative where there is no solid. The radius is larger by what rounding may put a line off that: DISTANCE_ERROR of
// the distance, at most 7 * frame.reach, are 7 place errors, proxies are wrong by up to 4, and the ray's position
// and direction by one.
vec4 sphere_around(vec3 center, float radius, float half_length, bool is_there) {
    float larger = 16.0 * place_error(), squared = radius * radius + half_length * half_length;
    // (r + larger)^2, r being no more than the sum of both; rounded a few times.
    squared += (2.0 * larger) * (radius + half_length + larger) + (16.0 * FLOAT_ROUNDOFF) * squared;
    return vec4(center, is_there ? squared : -FAR);
}

// All bits where the ray misses a bounding sphere.
int misses_sphere(vec4 bounding_sphere, TraversalRay traversal) {
    vec3 to_center = bounding_sphere.xyz - traversal.origin;
    float middle = dot(to_center, traversal.direction);
    vec3 across = to_center - middle * traversal.direction;
    float half_squared = bounding_sphere.w - dot(across, across);
    // Behind the ray's origin it is where its centre is by more than the radius.
    return if_negative(half_squared) | if_negative(bounding_sphere.w + middle * abs(middle));
}

// a: midpoint of the ends, radius; b: unit axis, half length.
uint key_of_cylinder(vec4 a, vec4 b, TraversalRay traversal, int entry, uint k) {
    vec3 from_middle = traversal.origin - a.xyz;
    float closest_t = -dot(from_middle, traversal.direction);
    vec3 closest = from_middle + closest_t * traversal.direction;
    float along = dot(b.xyz, closest), along_slope = dot(b.xyz, traversal.direction);
    vec3 across = closest - along * b.xyz, slope = traversal.direction - along_slope * b.xyz;
    float slope_squared = dot(slope, slope), across_squared = dot(across, across);
    float radius = a.w + 4.0 * place_error();
    float product = dot(across, slope);
    float chord_squared = product * product - slope_squared * (across_squared - radius * radius);
    float error = 2.0 * CHORD_ERROR * slope_squared * (across_squared + radius * radius) + chord_rounding();
    float chord = sqrt(max(chord_squared + error, 0.0));
    // Nearly along the axis the side says little, and nearly across it the ends.
    bool has_side = slope_squared > 1e-3, has_ends = abs(along_slope) > 1e-3;
    float by_slope = 1.0 / slope_squared, by_along = 1.0 / along_slope;
    float side_error = (64.0 * place_error()) * by_slope, end_error = (64.0 * place_error()) * abs(by_along);
    float side_middle = -product * by_slope, side_reach = chord * by_slope + side_error;
    float end_middle = -along * by_along, end_reach = (b.w + 4.0 * place_error()) * abs(by_along) + end_error;
    float side_near = has_side ? side_middle - side_reach : -FAR, side_far = has_side ? side_middle + side_reach : FAR;
    float end_near = has_ends ? end_middle - end_reach : -FAR, end_far = has_ends ? end_middle + end_reach : FAR;
    float near = max(side_near, end_near), far = min(side_far, end_far);
    int never = if_negative(b.w) | if_negative(far - near) | if_negative(far + (closest_t + place_error()));
    never |= has_side ? if_negative(chord_squared + error) : 0;
    return key_of(near + (closest_t - 4.0 * place_error()), never, entry, k);
}

vec4 bounding_sphere_of_cylinder(vec4 a, vec4 b) { return sphere_around(a.xyz, a.w, b.w, b.w >= 0.0); }

void tighten_by_cylinder(vec4 a, vec4 b, bool is_there, TraversalRay traversal, inout Found found) {}

// Below this sine of the half-angle a cone is taken for all between the planes of its apex and its base.
const float LEAST_SINE = 0.015625;

// a: apex, height; b: unit axis, base radius.
uint key_of_cone(vec4 a, vec4 b, TraversalRay traversal, int entry, uint k) {
    vec3 from_apex = traversal.origin - a.xyz;
    float closest_t = -dot(from_apex, traversal.direction);
    vec3 closest = from_apex + closest_t * traversal.direction;
    float along = dot(b.xyz, closest), along_slope = dot(b.xyz, traversal.direction);
    vec3 across = closest - along * b.xyz, slope = traversal.direction - along_slope * b.xyz;
    float height_squared = a.w * a.w, base_squared = b.w * b.w, by_sum = 1.0 / (height_squared + base_squared);
    float sine_squared = base_squared * by_sum, cosine_squared = height_squared * by_sum, sine = sqrt(sine_squared);
    // With the apex drawn back, so that the side is farther out by 4 place errors.
    float depth = along + 4.0 * place_error() / max(sine, LEAST_SINE);

    // a * s^2 + 2 * b * s + c <= 0 in the double cone, as in cone.glsl.
    float slope_out = cosine_squared * dot(slope, slope), slope_down = sine_squared * along_slope * along_slope;
    float out_squared = cosine_squared * dot(across, across), down_squared = sine_squared * depth * depth;
    float square = slope_out - slope_down;
    float product = cosine_squared * dot(across, slope) - sine_squared * depth * along_slope;
    float discriminant = product * product - square * (out_squared - down_squared);
    float error = 4.0 * CHORD_ERROR * (slope_out + slope_down) * (out_squared + down_squared) + chord_rounding();
    // Nearly along the side, and nearly across the axis, the side and the base say little.
    bool has_side = abs(square) > 0.01 && sine > LEAST_SINE, has_ends = abs(along_slope) > 1e-3;
    bool crosses = square > 0.0;
    float by_square = 1.0 / square, by_along = 1.0 / along_slope;
    float side_error = (64.0 * place_error()) * abs(by_square), end_error = (64.0 * place_error()) * abs(by_along);
    float side_middle = -product * by_square;
    // Between the roots, or beyond one of them: conservative either way.
    float side_reach = sqrt(max(crosses ? discriminant + error : discriminant - error, 0.0)) * abs(by_square);
    bool is_down = along_slope > 0.0;
    float side_near = crosses ? side_middle - side_reach : (is_down ? side_middle + side_reach : -FAR);
    float side_far = crosses ? side_middle + side_reach : (is_down ? FAR : side_middle - side_reach);
    side_near = has_side ? side_near - side_error : -FAR;
    side_far = has_side ? side_far + side_error : FAR;
    float half_height = 0.5 * a.w;
    float end_middle = (half_height - along) * by_along;
    float end_reach = (half_height + 4.0 * place_error()) * abs(by_along) + end_error;
    float end_near = has_ends ? end_middle - end_reach : -FAR, end_far = has_ends ? end_middle + end_reach : FAR;
    float near = max(side_near, end_near), far = min(side_far, end_far);
    int never = if_negative(b.w) | if_negative(far - near) | if_negative(far + (closest_t + place_error()));
    never |= has_side && crosses ? if_negative(discriminant + error) : 0;
    return key_of(near + (closest_t - 4.0 * place_error()), never, entry, k);
}

vec4 bounding_sphere_of_cone(vec4 a, vec4 b) {
    float half_height = 0.5 * a.w;
    return sphere_around(a.xyz + half_height * b.xyz, b.w, half_height, b.w >= 0.0);
}

void tighten_by_cone(vec4 a, vec4 b, bool is_there, TraversalRay traversal, inout Found found) {}
