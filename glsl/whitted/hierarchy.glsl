// The search through the solids of a kind, included once for each: SEARCH is its name, KEY_OF and SETTLE what looks at an
// outline of OUTLINE_ROWS rows, KIND the kind and LEVELS the number of levels over the solids. Where IS_DEAR, KEY_OF takes
// longer than to find out for all rays of a packet which outlines it is needed for, by MIDDLE_OF and SUPPORT_OF.
//
// The solids lie in such an order that each eight that begin with a multiple of eight are near each other, and so are
// each eight of these groups, and so on: level h holds a box around every 8^h of them, and where a box lies tells what is
// in it. src/tracer/hierarchy.rs makes the order, and the boxes.

// A group of the kind, and where the ray enters the box around it. A loop's body may have come here for nothing: then it
// does not count.
void TRY_EIGHT(uint group, int entry, bool counts, Beam beam, Bundle bundle, inout Found found) {
    uint first_group = first_slots()[KIND] / 8u;
    uint first = frame.outlines[KIND] + OUTLINE_ROWS * 8u * group;
    vec4 own_a = OWN_ROW(outlines, first, OUTLINE_ROWS);
    vec4 own_b = OUTLINE_ROWS == 1u ? vec4(0.0) : OWN_ROW(outlines, first + 1u, OUTLINE_ROWS);
#define A_OF_EIGHT(k) ROW_OF_EIGHT(own_a, outlines, first, OUTLINE_ROWS, k)
#define B_OF_EIGHT(k) (OUTLINE_ROWS == 1u ? vec4(0.0) : ROW_OF_EIGHT(own_b, outlines, first + 1u, OUTLINE_ROWS, k))
#define TRY_ONE(k) take(KEY_OF(A_OF_EIGHT(k), B_OF_EIGHT(k), beam, entry, k), k, eight);
#if OCTETS && IS_DEAR
    vec3 middle = MIDDLE_OF(own_a, own_b), normal = edge_normal(bundle, middle);
    float normal_support = SUPPORT_OF(own_a, own_b, normal), ahead_support = SUPPORT_OF(own_a, own_b, bundle.direction);
    uint left = solids_ahead(bundle, middle, normal, normal_support, ahead_support, found.limit);
    Group eight = group_of(first_group + group, counts && left != 0u, beam);
    for (;;) {
        turns++;
        uint k = uint(findLSB(left)) & 7u;
        TRY_ONE(k)
        left &= left - 1u;
        if (left == 0u) break;
    }
#else
    Group eight = group_of(first_group + group, counts, beam);
    EIGHT_TIMES(TRY_ONE)
#endif
    uint place = (eight.key + eight.first_key) & 7u;
    // Among few that takes longer than it saves.
    if (LEVELS > 1u) SETTLE(A_OF_EIGHT(place), B_OF_EIGHT(place), eight.key < eight.end, beam, found);
    take(eight, found);
#undef A_OF_EIGHT
#undef B_OF_EIGHT
#undef TRY_ONE
}

// A level that is alone is entered whole. Down several, a ray or a packet of eight goes group by group: `left` keeps, from
// bit 8 * (h - 2) on, which boxes of level h, in their order, are still to be gone into. Those of level 1 are gone into at
// once. What a level holds backwards has its bit in `backwards`.
void SEARCH(Beam beam, Bundle bundle, bool is_searching, inout Found found) {
    uint count = frame.counts[KIND];
    if (!is_searching) found.limit = HIDDEN;
    if (LEVELS == 0u) {
        uint group = 0u;
        for (;;) {
            turns++;
            TRY_EIGHT(group, 0, true, beam, bundle, found);
            group++;
            if (8u * group >= count) break;
        }
    } else if (LEVELS == 1u) {
        uint boxes = eighths(count), first = first_box_row(KIND), second = first + second_group(count);
        OwnBox own_low, own_high;
        if (IS_ONLY_KIND) {
            own_low = held[0];
            own_high = held[1];
        } else {
            own_low = own_box(first);
            own_high = own_box(second);
        }
        Entries low = enter_boxes(own_low, first, beam), high = enter_boxes(own_high, second, beam);
        bool are_backwards = bundle.heading[order_of_boxes(own_low, first)] < 0.0;
        uint left = (1u << boxes) - 1u;
        left &= bits_of_packet(boxes_ahead(low, end_of(found)) | boxes_ahead(high, end_of(found)) << 8u);
        for (;;) {
            turns++;
            bool is_leaf = left != 0u;
            uint place = uint(are_backwards ? findMSB(left) : findLSB(left));
            place = is_leaf ? place : 0u;
            left &= ~(1u << place);
            int entry = place < 8u ? entry_of(low, place) : entry_of(high, place);
            TRY_EIGHT(place, entry, is_leaf, beam, bundle, found);
            left &= bits_of_packet(boxes_ahead(low, end_of(found)) | boxes_ahead(high, end_of(found)) << 8u);
            if (left == 0u) break;
        }
    } else {
        // Where the boxes of each level begin.
        uint rows[7];
        uint boxes = eighths(count);
        rows[1] = first_box_row(KIND);
        [[unroll]] for (uint h = 2u; h <= 6u; h++) {
            rows[h] = rows[h - 1u] + 2u * padded(boxes);
            boxes = h <= LEVELS ? eighths(boxes) : boxes;
        }

        uint root = (1u << eighths(boxes)) - 1u;
        const uint root_bit = 8u * (LEVELS - 1u);
        uvec2 left = root_bit < 32u ? uvec2(root << root_bit, 0u) : uvec2(0u, root << (root_bit - 32u));
        uint backwards = 0u;
        uint path = 0u; // the group of level 1 that was gone into last, or the first below the one of a higher level

        for (;;) {
            turns++;
            uint leaves;
            bool are_leaves_backwards;
            Entries entries;
            for (;;) {
                turns++;
                bool is_low = LEVELS <= 4u || left.x != 0u;
                uint bit = is_low ? uint(findLSB(left.x)) : 32u + uint(findLSB(left.y));
                left = is_low ? uvec2(left.x & (left.x - 1u), left.y) : uvec2(0u, left.y & (left.y - 1u));
                uint level = bit / 8u + 1u; // of the boxes to look at now
                uint place = (backwards >> level & 1u) != 0u ? 7u - bit % 8u : bit % 8u;
                uint group = (path >> 3u * level) * 8u + place;
                path = group << 3u * (level - 1u);

                uint first = rows[1];
                [[unroll]] for (uint h = 2u; h <= 6u; h++) first = h <= LEVELS && level == h ? rows[h] : first;
                first += 16u * group;
                OwnBox own = own_box(first);
                entries = enter_boxes(own, first, beam);
                leaves = bits_of_packet(boxes_ahead(entries, end_of(found)));
                are_leaves_backwards = bundle.heading[order_of_boxes(own, first)] < 0.0;
                uint met = are_leaves_backwards ? bitfieldReverse(leaves) >> 24 : leaves;
                uint backwards_bit = 1u << (level - 1u);
                backwards = are_leaves_backwards ? backwards | backwards_bit : backwards & ~backwards_bit;
                // Of level 1, `shift` has no meaning.
                uint shift = 8u * (level - 2u);
                leaves = level == 1u ? leaves : 0u;
                left.x |= level > 1u && shift < 32u ? met << shift : 0u;
                if (LEVELS > 5u) left.y |= level > 1u && shift >= 32u ? met << (shift - 32u) : 0u;
                if (leaves != 0u || (left.x | left.y) == 0u) break;
            }

            for (;;) {
                turns++;
                bool is_leaf = leaves != 0u;
                uint place = uint(are_leaves_backwards ? findMSB(leaves) : findLSB(leaves));
                place = is_leaf ? place : 0u;
                leaves &= ~(1u << place);
                TRY_EIGHT(8u * path + place, entry_of(entries, place), is_leaf, beam, bundle, found);
                leaves &= bits_of_packet(boxes_ahead(entries, end_of(found)));
                if (leaves == 0u) break;
            }
            bool ends = (left.x | left.y) == 0u || turns >= LOOP_TURNS;
            if (ends || !any_of_packet(found.limit > HIDDEN)) break;
        }
    }
}
