// A packet's search through the solids of a kind: what one of its rays needs, all of them look at.

#if IS_DEAR
#define SOLIDS_AHEAD(own, traversal, found) \
    bounding_spheres_ahead(OF_KIND(bounding_sphere_of)(own.a, own.b), traversal, found.limit > HIDDEN)
#else
#define SOLIDS_AHEAD(own, traversal, found) 0xFFu
#endif

// A group of the kind, and where the ray enters the box around it; `left`: which of its solids some ray may meet. A
// loop's body may have come here for nothing, with none of them.
void OF_KIND(try_eight)(uint group, OwnOutline own, uint left, int entry, TraversalRay traversal, inout Found found) {
#define A_OF_EIGHT(k) of_packet(own.a, k)
#define B_OF_EIGHT(k) (PROXY_ROWS == 1u ? vec4(0.0) : of_packet(own.b, k))
#define TRY_ONE(k) take(OF_KIND(key_of)(A_OF_EIGHT(k), B_OF_EIGHT(k), traversal, entry, k), k, eight);
    Group eight = group_of(first_slots()[KIND] / 8u + group, left != 0u, traversal);
#if IS_DEAR
    for (;;) {
        iterations++;
        uint k = uint(findLSB(left)) & 7u;
        TRY_ONE(k)
        left &= left - 1u;
        if (left == 0u) break;
    }
#else
    EIGHT_TIMES(TRY_ONE)
#endif
    uint place = (eight.key + eight.first_key) & 7u;
    // Among few that takes longer than it saves.
    if (LEVELS > 1u) OF_KIND(tighten_by)(A_OF_EIGHT(place), B_OF_EIGHT(place), eight.key < eight.end, traversal, found);
    take(eight, found);
#undef A_OF_EIGHT
#undef B_OF_EIGHT
#undef TRY_ONE
}

// Up to sixteen groups from `first` on, a bit each, and where the ray enters the boxes around them.
void OF_KIND(try_groups)(uint first, uint left, bool are_backwards, Entries low, Entries high, TraversalRay traversal,
                inout Found found) {
    for (;;) {
        iterations++;
        uint place, solids;
        OwnOutline own;
        for (;;) {
            bool is_there = left != 0u;
            place = uint(are_backwards ? findMSB(left) : findLSB(left));
            place = is_there ? place : 0u;
            left &= ~(1u << place);
            own = own_outline(frame.proxies[KIND], first + place, PROXY_ROWS);
            solids = is_there ? SOLIDS_AHEAD(own, traversal, found) : 0u;
#if IS_DEAR
            iterations++;
            // Where no ray meets any of them, on to the next group at once.
            if (solids != 0u || left == 0u) break;
#else
            break;
#endif
        }
        int entry = LEVELS == 1u && place >= 8u ? entry_of(high, place) : entry_of(low, place);
        OF_KIND(try_eight)(first + place, own, solids, LEVELS == 0u ? 0 : entry, traversal, found);
        if (LEVELS > 0u) {
            uint ahead = boxes_ahead(low, end_of(found));
            if (LEVELS == 1u) ahead |= boxes_ahead(high, end_of(found)) << 8u;
            left &= bits_of_packet(ahead);
        }
        if (left == 0u) break;
    }
}

// A level that is alone is entered whole. Down several, a packet goes group by group.
void OF_KIND(search)(TraversalRay traversal, bool is_searching, inout Found found) {
    uint count = frame.counts[KIND];
    // The direction of one ray, which decides the order for all.
    vec3 heading = of_packet(traversal.direction, 0u);
    if (!is_searching) found.limit = HIDDEN;
    if (LEVELS == 0u) {
        Entries none;
        uint first = 0u;
        for (;;) {
            iterations++;
            OF_KIND(try_groups)(first, (1u << min(eighths(count) - first, 16u)) - 1u, false, none, none, traversal, found);
            first += 16u;
            if (first >= eighths(count)) break;
        }
    } else if (LEVELS == 1u) {
        uint first = first_box_row(KIND), second = first + second_group(count);
        OwnBox own_low, own_high;
        if (IS_ONLY_KIND) {
            own_low = held[0];
            own_high = held[1];
        } else {
            own_low = own_box(first);
            own_high = own_box(second);
        }
        Entries low = enter_boxes(own_low, traversal), high = enter_boxes(own_high, traversal);
        bool are_backwards = heading[order_of_boxes(own_low)] < 0.0;
        uint left = (1u << eighths(count)) - 1u;
        left &= bits_of_packet(boxes_ahead(low, end_of(found)) | boxes_ahead(high, end_of(found)) << 8u);
        OF_KIND(try_groups)(0u, left, are_backwards, low, high, traversal, found);
    } else {
        Descent descent = descent_of(KIND, LEVELS);
        for (;;) {
            iterations++;
            uint leaves;
            bool are_leaves_backwards;
            Entries entries;
            for (;;) {
                iterations++;
                uint first, level = next_group(LEVELS, first, descent);
                OwnBox own = own_box(first);
                entries = enter_boxes(own, traversal);
                leaves = bits_of_packet(boxes_ahead(entries, end_of(found)));
                are_leaves_backwards = heading[order_of_boxes(own)] < 0.0;
                keep(leaves, are_leaves_backwards, level, LEVELS, descent);
                leaves = level == 1u ? leaves : 0u;
                if (leaves != 0u || is_over(descent)) break;
            }

            OF_KIND(try_groups)(8u * descent.path, leaves, are_leaves_backwards, entries, entries, traversal, found);
            if (is_over(descent) || has_run_out() || !any_of_packet(found.limit > HIDDEN)) break;
        }
    }
}

#undef SOLIDS_AHEAD
