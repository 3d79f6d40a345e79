// Eight boxes of a hierarchy's level, and the up to sixteen that are a level alone.

// Where the ray enters each, by the bits of t; NOT_MET.
struct Entries {
    int at[8];
};

const int NOT_MET = 0x7FFFFFFF;

// Entry of the box with that number, whose last three bits count.
int entry_of(Entries entries, uint place) {
    bool is_odd = (place & 1u) != 0u, is_second = (place & 2u) != 0u, is_late = (place & 4u) != 0u;
    int of_01 = is_odd ? entries.at[1] : entries.at[0], of_23 = is_odd ? entries.at[3] : entries.at[2];
    int of_45 = is_odd ? entries.at[5] : entries.at[4], of_67 = is_odd ? entries.at[7] : entries.at[6];
    return is_late ? (is_second ? of_67 : of_45) : (is_second ? of_23 : of_01);
}

// What lies beyond is of no interest: beyond the limit, or behind two candidates.
int end_of(Found found) { return min(floatBitsToInt(found.limit), int(min(found.next_key | 7u, uint(NOT_MET) - 1u))); }

// Which of the boxes the ray enters before the end: a bit each.
uint boxes_ahead(Entries entries, int end) {
    uint ahead = 0u;
#define COMPARE_ONE(k) ahead |= entries.at[k] > end ? 0u : 1u << k;
    EIGHT_TIMES(COMPARE_ONE)
#undef COMPARE_ONE
    return ahead;
}

// The rows from which the invocation hands its packet one of eight boxes.
struct OwnBox {
    vec4 middle;
    vec4 half_size;
};

OwnBox own_box(uint first) { return OwnBox(OWN_ROW(proxies, first, 2u), OWN_ROW(proxies, first + 1u, 2u)); }

// The axis along which the eight lie one behind the other that begin in row `first`.
uint order_of_boxes(OwnBox own, uint first) { return uint(ROW_OF_EIGHT(own.half_size, proxies, first + 1u, 2u, 0u).w); }

Entries enter_boxes(OwnBox own, uint first, TraversalRay traversal) {
    vec3 steepness = abs(traversal.inverse);
    Entries entries;
#define ENTER_ONE(k)                                                                                   \
    {                                                                                                  \
        vec3 at = (ROW_OF_EIGHT(own.middle, proxies, first, 2u, k).xyz - traversal.origin) * traversal.inverse; \
        vec3 reach = ROW_OF_EIGHT(own.half_size, proxies, first + 1u, 2u, k).xyz * steepness;         \
        ivec3 enters = floatBitsToInt(at - reach), leaves = floatBitsToInt(at + reach);                \
        int near = max(max(enters.x, enters.y), max(enters.z, 0));                                     \
        entries.at[k] = near > min(min(leaves.x, leaves.y), leaves.z) ? NOT_MET : near;                \
    }
    EIGHT_TIMES(ENTER_ONE)
#undef ENTER_ONE
    return entries;
}

// Groups of eight that so many are, and all that these have room for.
uint eighths(uint count) { return (count + 7u) >> 3; }
uint padded(uint count) { return eighths(count) << 3; }

// Where the boxes over a kind's solids begin.
uint first_box_row(uint kind) {
    uint proxy_rows = kind == 0u ? 1u : 2u;
    return frame.proxies[kind] + proxy_rows * padded(frame.counts[kind]);
}

// A single level is up to sixteen boxes, two groups, and every search enters them all. Where there is no second group,
// the first is fetched twice, and nothing of it counts the second time.
uint second_group(uint count) { return eighths(count) > 8u ? 16u : 0u; }

// Of a kind that is the only one, they are read once.
OwnBox held[2];

void hold_boxes() {
    if (IS_ONLY_KIND && SPHERE_LEVELS + BOX_LEVELS + CYLINDER_LEVELS + CONE_LEVELS == 1u) {
        uint kind = HAS_SPHERES ? 0u : (HAS_BOXES ? 1u : (HAS_CYLINDERS ? 2u : 3u));
        uint first = first_box_row(kind);
        held[0] = own_box(first);
        held[1] = own_box(first + second_group(frame.counts[kind]));
    }
}
