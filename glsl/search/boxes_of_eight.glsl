// Eight boxes of a hierarchy's level, and the up to sixteen that are a level alone.

// Where the ray enters each, by the bits of t; NOT_MET.
struct Entries {
    int at[8];
};

// Entry of the box with that number, whose last three bits count.
int entry_of(Entries entries, uint place) {
    bool is_odd = (place & 1u) != 0u, is_second = (place & 2u) != 0u, is_late = (place & 4u) != 0u;
    int of_01 = is_odd ? entries.at[1] : entries.at[0], of_23 = is_odd ? entries.at[3] : entries.at[2];
    int of_45 = is_odd ? entries.at[5] : entries.at[4], of_67 = is_odd ? entries.at[7] : entries.at[6];
    return is_late ? (is_second ? of_67 : of_45) : (is_second ? of_23 : of_01);
}

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

// The axis along which the eight lie one behind the other.
uint order_of_boxes(OwnBox own) { return uint(of_packet(own.half_size, 0u).w); }

Entries enter_boxes(OwnBox own, TraversalRay traversal) {
    Entries entries;
#define ENTER_ONE(k) \
    entries.at[k] = entry_of_box(of_packet(own.middle, k).xyz, of_packet(own.half_size, k).xyz, traversal);
    EIGHT_TIMES(ENTER_ONE)
#undef ENTER_ONE
    return entries;
}

// A single level is up to sixteen boxes, two groups, and every search enters them all. Where there is no second group,
// the first is fetched twice, and nothing of it counts the second time.
uint second_group(uint count) { return eighths(count) > 8u ? 16u : 0u; }

// Of a kind that is the only one, they are read once.
OwnBox held[2];

void hold() {
    held_view = view();
    if (IS_ONLY_KIND && SPHERE_LEVELS + BOX_LEVELS + CYLINDER_LEVELS + CONE_LEVELS == 1u) {
        uint kind = HAS_SPHERES ? 0u : (HAS_BOXES ? 1u : (HAS_CYLINDERS ? 2u : 3u));
        uint first = first_box_row(kind);
        held[0] = own_box(first);
        held[1] = own_box(first + second_group(frame.counts[kind]));
    }
}
