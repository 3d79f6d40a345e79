// The cheap search before the exact solve: bounds in float, whatever the kernel's precision, which are on the safe
// side.
//
// No coordinate of a solid or a ray's origin is larger than 2 * frame.reach: an error bound that is right there is
// right everywhere.
//
// Numbers from 0 on are in the order of their bits, which the search compares: a CPU driver takes one instruction for
// the least of two integers, and three for that of two floats, because of NaN. What is negative, or not a number
// because of something negative, is recognised by its sign bit.

const float FAR = 3.4028234663852886e38;
const float FLOAT_ROUNDOFF = 5.9604644775390625e-8;

// What a computed position may be off: differences and products of numbers up to 4 * frame.reach, rounded a few times,
// and the rounding to float of the camera, of a unit of FLOAT_ROUNDOFF * frame.reach, and for the double kernel of all
// rays and proxies.
float place_error() { return 16.0 * FLOAT_ROUNDOFF * frame.reach; }

struct TraversalRay {
    vec3 origin;
    vec3 direction;     // unit
    vec3 inverse;       // 1 / direction, finite
    float plane_error;  // of the t at which a box's face is met, as that face may be off by 4 place errors
    uint skipped;       // slot that cannot be met, or NOTHING
    // Candidates up to this one have been tested.
    uint after_key;
    int after_group;
    // Size of the coordinates of a shadow ray's light; negative for other rays.
    float target_size;
};

// The first candidate that a search finds. Its key is a lower bound of t by its bits; the last three are its index
// in its group of eight slots; candidates with one key come in the order of their groups.
struct Found {
    uint key;
    int group;
    uint next_key;  // of the second
    float limit;    // nothing beyond it is of interest; shrinks where something is met for sure
};

const uint NO_KEY = 0x80000000u; // and all above

// The limit of a shadow ray that met something before its light for sure.
const float HIDDEN = -FAR;

// Error of a height above or below a surface, relative to its coordinates: four times SURFACE_ERROR of floats.
const float HIDING_ERROR = 32.0 * FLOAT_ROUNDOFF;

const float LEAST_SLOPE = 1e-12;

TraversalRay traversal_ray_of(Ray ray) {
    TraversalRay traversal;
    traversal.origin = vec3(ray.origin);
    traversal.direction = vec3(ray.direction);
    // A direction changed by 1e-12 misses its target by less than a place error, and 1/0 with all that comes of it is
    // not.
    vec3 slope = mix(traversal.direction, vec3(LEAST_SLOPE), lessThan(abs(traversal.direction), vec3(LEAST_SLOPE)));
    traversal.inverse = 1.0 / slope;
    vec3 steepness = abs(traversal.inverse);
    traversal.plane_error = (4.0 * place_error()) * (steepness.x + steepness.y + steepness.z);
    traversal.skipped = NOTHING;
    traversal.after_key = 0u;
    traversal.after_group = -1;
    traversal.target_size = -1.0;
    return traversal;
}

// All bits where a number is negative.
int if_negative(float number) { return floatBitsToInt(number) >> 31; }

// A candidate of index `k` in its group that may be met from `t` on, and from its box's entry, unless `never` has a
// bit. A box that is entered behind a candidate so has none in it that comes before that one.
uint key_of(float t, int never, int entry, uint k) {
    return (uint(max(floatBitsToInt(t), entry)) & ~7u | k) | uint(never);
}

// What a search makes of a group's keys, each less the first that counts: what has been tested becomes larger than all
// others by that.
struct Group {
    int index;
    uint skipped;   // index of what cannot be met, if it is in this group
    uint first_key;
    uint end;       // of keys that count, less the first
    uint key;       // the least
    uint next_key;  // and the one after it
};

Group group_of(uint index, bool counts, TraversalRay traversal) {
    uint first_key = traversal.after_key + (int(index) > traversal.after_group ? 0u : 1u);
    uint end = counts ? NO_KEY - first_key : 0u;
    return Group(int(index), traversal.skipped - 8u * index, first_key, end, 0xFFFFFFFFu, 0xFFFFFFFFu);
}

void take(uint key, uint k, inout Group group) {
    uint counted = (group.skipped == k ? 0xFFFFFFFFu : key) - group.first_key;
    group.next_key = min(group.next_key, max(group.key, counted));
    group.key = min(group.key, counted);
}

void take(Group group, inout Found found) {
    uint key = group.key < group.end ? group.key + group.first_key : NO_KEY;
    uint next_key = group.next_key < group.end ? group.next_key + group.first_key : NO_KEY;
    bool is_first = key < found.key || (key == found.key && group.index < found.group);
    found.next_key = min(min(found.next_key, next_key), max(found.key, key));
    found.group = is_first ? group.index : found.group;
    found.key = min(found.key, key);
}

// What is met for sure, at `t` at the latest, ends the search for what lies beyond; or all of it, where that hides the
// light: it is before the light by more than its rounding, at a sine to the surface of rise by run.
void tighten(bool is_met, float t, float rise, float run, TraversalRay traversal, inout Found found) {
    bool is_shadow = traversal.target_size >= 0.0;
    // Where something lets light through, what hides a light is known of its material only.
    bool hides = MEDIA == NO_MEDIA && (found.limit - t) * rise > HIDING_ERROR * (traversal.target_size + 2.0 * frame.reach) * run;
    float limit = is_shadow ? (hides ? HIDDEN : FAR) : t;
    found.limit = is_met && limit < found.limit ? limit : found.limit;
}
