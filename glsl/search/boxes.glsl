// The boxes over the solids of a kind: where they lie, and where a ray enters one.

const int NOT_MET = 0x7FFFFFFF;

// By the bits of t, or NOT_MET.
int entry_of_box(vec3 middle, vec3 half_size, TraversalRay traversal) {
    vec3 at = (middle - traversal.origin) * traversal.inverse, reach = half_size * abs(traversal.inverse);
    ivec3 enters = floatBitsToInt(at - reach), leaves = floatBitsToInt(at + reach);
    int near = max(max(enters.x, enters.y), max(enters.z, 0));
    return near > min(min(leaves.x, leaves.y), leaves.z) ? NOT_MET : near;
}

// What lies beyond is of no interest: beyond the limit, or behind two candidates.
int end_of(Found found) { return min(floatBitsToInt(found.limit), int(min(found.next_key | 7u, uint(NOT_MET) - 1u))); }

// Groups of eight that so many are, and all that these have room for.
uint eighths(uint count) { return (count + 7u) >> 3; }
uint padded(uint count) { return eighths(count) << 3; }

// Where the boxes over a kind's solids begin.
uint first_box_row(uint kind) {
    uint proxy_rows = kind == 0u ? 1u : 2u;
    return frame.proxies[kind] + proxy_rows * padded(frame.counts[kind]);
}

// The way down several levels of boxes, group by group.
struct Descent {
    uint rows[7];   // where the boxes of each level begin
    // From bit 8 * (h - 2) on, which boxes of level h, in their order, are still to be gone into. What a level holds
    // backwards has its bit in `backwards`.
    uvec2 left;
    uint backwards;
    uint path;      // the group of level 1 that was gone into last, or the first below the one of a higher level
};

Descent descent_of(uint kind, uint levels) {
    Descent descent;
    uint boxes = eighths(frame.counts[kind]);
    descent.rows[1] = first_box_row(kind);
    [[unroll]] for (uint h = 2u; h <= 6u; h++) {
        descent.rows[h] = descent.rows[h - 1u] + 2u * padded(boxes);
        boxes = h <= levels ? eighths(boxes) : boxes;
    }
    uint root = (1u << eighths(boxes)) - 1u;
    uint root_bit = 8u * (levels - 1u);
    descent.left = root_bit < 32u ? uvec2(root << root_bit, 0u) : uvec2(0u, root << (root_bit - 32u));
    descent.backwards = 0u;
    descent.path = 0u;
    return descent;
}

bool is_over(Descent descent) { return (descent.left.x | descent.left.y) == 0u; }

// On to the next group of boxes: its level and the row in which it begins.
uint next_group(uint levels, out uint first, inout Descent descent) {
    uvec2 left = descent.left;
    bool is_low = levels <= 4u || left.x != 0u;
    uint bit = is_low ? uint(findLSB(left.x)) : 32u + uint(findLSB(left.y));
    descent.left = is_low ? uvec2(left.x & (left.x - 1u), left.y) : uvec2(0u, left.y & (left.y - 1u));
    uint level = bit / 8u + 1u;
    uint place = (descent.backwards >> level & 1u) != 0u ? 7u - bit % 8u : bit % 8u;
    uint group = (descent.path >> 3u * level) * 8u + place;
    descent.path = group << 3u * (level - 1u);
    first = descent.rows[1];
    [[unroll]] for (uint h = 2u; h <= 6u; h++) first = h <= levels && level == h ? descent.rows[h] : first;
    first += 16u * group;
    return level;
}

// Which boxes of the group there are to be gone into: a bit each. Those of level 1 are gone into at once.
void keep(uint ahead, bool are_backwards, uint level, uint levels, inout Descent descent) {
    uint met = are_backwards ? bitfieldReverse(ahead) >> 24 : ahead;
    uint backwards_bit = 1u << (level - 1u);
    descent.backwards = are_backwards ? descent.backwards | backwards_bit : descent.backwards & ~backwards_bit;
    // Of level 1, `shift` has no meaning.
    uint shift = 8u * (level - 2u);
    descent.left.x |= level > 1u && shift < 32u ? met << shift : 0u;
    if (levels > 5u) descent.left.y |= level > 1u && shift >= 32u ? met << (shift - 32u) : 0u;
}
