// The search through the solids of a kind, included once for each: KIND is the kind, OF_KIND makes a function's name
// for it, LEVELS is the number of levels over the solids, PROXY_ROWS how many rows a proxy takes. Where IS_DEAR, a
// proxy's key takes so long to find that a packet first tests a bounding sphere around the solid.
//
// The solids lie in such an order that each eight that begin with a multiple of eight are near each other, and so are
// each eight of these groups, and so on: level h holds a box around every 8^h of them, and the position of a box gives
// its contents. src/tracer/whitted/hierarchy.rs makes the order, and the boxes.

#if KIND == SPHERES
#define OF_KIND(function) function##_sphere
#define LEVELS SPHERE_LEVELS
#define PROXY_ROWS 1u
#define IS_DEAR 0
#elif KIND == BOXES
#define OF_KIND(function) function##_box
#define LEVELS BOX_LEVELS
#define PROXY_ROWS 2u
#define IS_DEAR 0
#elif KIND == CYLINDERS
#define OF_KIND(function) function##_cylinder
#define LEVELS CYLINDER_LEVELS
#define PROXY_ROWS 2u
#define IS_DEAR 1
#elif KIND == CONES
#define OF_KIND(function) function##_cone
#define LEVELS CONE_LEVELS
#define PROXY_ROWS 2u
#define IS_DEAR 1
#endif

#if IS_DEAR && PACKETS
#define SOLIDS_AHEAD(own, traversal, found) \
    bounding_spheres_ahead(OF_KIND(bounding_sphere_of)(own.a, own.b), traversal, found.limit > HIDDEN)
#else
#define SOLIDS_AHEAD(own, traversal, found) 0xFFu
#endif

// A group of the kind, and where the ray enters the box around it; `left`: which of its solids some ray may meet. A
// loop's body may have come here for nothing, with none of them.
void OF_KIND(try_eight)(uint group, OwnOutline own, uint left, int entry, TraversalRay traversal, inout Found found) {
#define A_OF_EIGHT(k) ROW_OF_EIGHT(own.a, proxies, own.first, PROXY_ROWS, k)
#define B_OF_EIGHT(k) (PROXY_ROWS == 1u ? vec4(0.0) : ROW_OF_EIGHT(own.b, proxies, own.first + 1u, PROXY_ROWS, k))
#define TRY_ONE(k) take(OF_KIND(key_of)(A_OF_EIGHT(k), B_OF_EIGHT(k), traversal, entry, k), k, eight);
    Group eight = group_of(first_slots()[KIND] / 8u + group, left != 0u, traversal);
#if IS_DEAR && PACKETS
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
#if IS_DEAR && PACKETS
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

// A level that is alone is entered whole. Down several, a ray or a packet of eight goes group by group: `left` keeps,
// from bit 8 * (h - 2) on, which boxes of level h, in their order, are still to be gone into. Those of level 1 are gone
// into at once. What a level holds backwards has its bit in `backwards`.
void OF_KIND(search)(TraversalRay traversal, vec3 heading, bool is_searching, inout Found found) {
    uint count = frame.counts[KIND];
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
        Entries low = enter_boxes(own_low, first, traversal), high = enter_boxes(own_high, second, traversal);
        bool are_backwards = heading[order_of_boxes(own_low, first)] < 0.0;
        uint left = (1u << eighths(count)) - 1u;
        left &= bits_of_packet(boxes_ahead(low, end_of(found)) | boxes_ahead(high, end_of(found)) << 8u);
        OF_KIND(try_groups)(0u, left, are_backwards, low, high, traversal, found);
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
            iterations++;
            uint leaves;
            bool are_leaves_backwards;
            Entries entries;
            for (;;) {
                iterations++;
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
                entries = enter_boxes(own, first, traversal);
                leaves = bits_of_packet(boxes_ahead(entries, end_of(found)));
                are_leaves_backwards = heading[order_of_boxes(own, first)] < 0.0;
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

            OF_KIND(try_groups)(8u * path, leaves, are_leaves_backwards, entries, entries, traversal, found);
            bool ends = (left.x | left.y) == 0u || has_run_out();
            if (ends || !any_of_packet(found.limit > HIDDEN)) break;
        }
    }
}

#undef SOLIDS_AHEAD
#undef OF_KIND
#undef LEVELS
#undef PROXY_ROWS
#undef IS_DEAR
