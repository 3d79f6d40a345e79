// The cheap reject before the exact solve.

// Mesa's CPU drivers cut an invocation's loops short, without a word, after 65535 turns of all of them together: there
// the search ends before that, and says so. Turns are counted where there may be many of them.
layout(constant_id = 7) const uint LOOP_TURNS = 0xFFFFFFFFu;
uint turns = 0u;

// Of a chunk's own loop, of that over its bounds, and each loop's last, in which it ends.
const uint CHUNK_TURNS = 8u;

// Bounds the rounding errors of `may_meet` relative to the squared distance: 2u for the difference, 3u for each dot
// product and 4u for the direction's length, each at most once.
const Real REJECT_ERROR = 16.0 * UNIT_ROUNDOFF;

// No only where the ray's line passes the sphere around a primitive, leads away from it, or reaches it beyond `limit`.
bool may_meet(Real4 bound, Ray ray, Real limit) {
    Real3 to_center = bound.xyz - ray.origin;
    Real ahead = dot(to_center, ray.direction);
    Real distance_squared = dot(to_center, to_center);
    Real reach_squared = bound.w * bound.w + REJECT_ERROR * distance_squared;
    bool passes = distance_squared - ahead * ahead > reach_squared;
    bool leads_away = ahead < 0.0 && distance_squared > reach_squared;
    bool is_beyond = ahead - bound.w - REJECT_ERROR * (abs(ahead) + bound.w) > limit;
    return !(passes || leads_away || is_beyond);
}

// Which of `count` <= 32 slots from `first` on the ray may meet, a bit each. A convex solid cannot be met again from
// outside, and from inside its exit always is.
uint candidates(Ray ray, Departure departure, uint first, uint count, Real limit) {
    uint found = 0u;
    // By eights, for the sake of LOOP_TURNS.
    for (uint i = 0u; i < count; i += 8u) {
        [[unroll]] for (uint k = 0u; k < 8u; k++) {
            bool meets = may_meet(bounds[first + min(i + k, count - 1u)], ray, limit);
            found |= meets && i + k < count ? 1u << (i + k) : 0u;
        }
    }
    uint own = departure.slot - first;
    if (own < count) found = departure.inside ? found | 1u << own : found & ~(1u << own);
    return found;
}

uint origin_of(Departure departure, uint slot) {
    if (departure.slot == NOTHING) return FREE;
    return departure.slot == slot ? OWN_INSIDE : OTHER_SURFACE;
}

// Whether a hit lies before a target at a distance along the ray. A target on the solid's surface, to rounding, is not
// hidden by it from the side the ray comes from.
bool is_before(Hit hit, Ray ray, Real3 target, Real distance, Real solid_size) {
    Real height_of_target = (distance - hit.t) * abs(dot(hit.normal, ray.direction));
    return height_of_target > SURFACE_ERROR * (largest_component(target) + solid_size);
}
