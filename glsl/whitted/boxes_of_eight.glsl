// Eight boxes of a hierarchy's level.

// Where the ray enters each, by the bits of t; NOT_MET.
struct Entries {
    int at[8];
};

const int NOT_MET = 0x7FFFFFFF;

int entry_of(Entries entries, uint place) {
    int entry = entries.at[0];
#define CHOOSE_ONE(k) entry = place == k ? entries.at[k] : entry;
    EIGHT_TIMES(CHOOSE_ONE)
#undef CHOOSE_ONE
    return entry;
}

// What lies beyond is of no interest: beyond the limit, or behind two candidates.
int end_of(Found found) { return min(floatBitsToInt(found.limit), int(min(found.next_key | 7u, uint(NOT_MET) - 1u))); }

// Which of the boxes the ray, or any of its packet, enters before the end: a bit each.
uint boxes_ahead(Entries entries, int end) {
    uint ahead = 0u;
#define COMPARE_ONE(k) ahead |= entries.at[k] > end ? 0u : 1u << k;
    EIGHT_TIMES(COMPARE_ONE)
#undef COMPARE_ONE
    return bits_of_packet(ahead);
}

// `order`: the axis along which they lie one behind the other.
Entries enter_boxes(uint first, Beam beam, out uint order) {
    vec4 own_middle = OWN_ROW(outlines, first, 2u);
    vec4 own_half = OWN_ROW(outlines, first + 1u, 2u);
    vec3 steepness = abs(beam.inverse);
    Entries entries;
#define ENTER_ONE(k)                                                                                     \
    {                                                                                                    \
        vec3 at = (ROW_OF_EIGHT(own_middle, outlines, first, 2u, k).xyz - beam.origin) * beam.inverse;   \
        vec3 reach = ROW_OF_EIGHT(own_half, outlines, first + 1u, 2u, k).xyz * steepness;                \
        ivec3 enters = floatBitsToInt(at - reach), leaves = floatBitsToInt(at + reach);                  \
        int near = max(max(enters.x, enters.y), max(enters.z, 0));                                       \
        entries.at[k] = near > min(min(leaves.x, leaves.y), leaves.z) ? NOT_MET : near;                  \
    }
    EIGHT_TIMES(ENTER_ONE)
#undef ENTER_ONE
    order = uint(ROW_OF_EIGHT(own_half, outlines, first + 1u, 2u, 0u).w);
    return entries;
}

// Groups of eight that so many are, and all that these have room for.
uint eighths(uint count) { return (count + 7u) >> 3; }
uint padded(uint count) { return eighths(count) << 3; }
