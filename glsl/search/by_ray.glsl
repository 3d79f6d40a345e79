// The search of a ray that goes for itself through the solids of a kind: one row at a time, so that little is kept at
// once. A GPU hides the time that a row takes by the other rays it has registers for.

void OF_KIND(try_one)(uint group_row, uint k, int entry, TraversalRay traversal, inout Group eight) {
    int row = int(group_row + PROXY_ROWS * k);
    vec4 a = texelFetch(proxies, row);
    vec4 b = PROXY_ROWS == 1u ? vec4(0.0) : texelFetch(proxies, row + 1);
    take(OF_KIND(key_of)(a, b, traversal, entry, k), k, eight);
}

// The solids of a group, whose box the ray enters at `entry`.
void OF_KIND(try_eight)(uint group, int entry, TraversalRay traversal, inout Found found) {
    uint row = frame.proxies[KIND] + 8u * PROXY_ROWS * group;
    uint count = LEVELS == 0u ? min(frame.counts[KIND] - 8u * group, 8u) : 8u;
    Group eight = group_of(first_slots()[KIND] / 8u + group, true, traversal);
    if (MAX_ITERATIONS > 0u) {
        // Where iterations are few, all in one.
#define TRY_ONE(k) OF_KIND(try_one)(row, k, entry, traversal, eight);
        EIGHT_TIMES(TRY_ONE)
#undef TRY_ONE
    } else {
        uint k = 0u;
        [[dont_unroll]] for (;;) {
            OF_KIND(try_one)(row, k, entry, traversal, eight);
            k++;
            if (k == count) break;
        }
    }
    // Among few that takes longer than it saves.
    if (LEVELS > 1u && eight.key < eight.end) {
        row += PROXY_ROWS * (eight.key + eight.first_key & 7u);
        vec4 a = texelFetch(proxies, int(row));
        vec4 b = PROXY_ROWS == 1u ? vec4(0.0) : texelFetch(proxies, int(row + 1u));
        OF_KIND(tighten_by)(a, b, true, traversal, found);
    }
    take(eight, found);
}

// The groups from `group` on under the boxes that begin in row `first`, and are so many, along the ray.
void OF_KIND(try_groups)(uint first, uint group, uint count, TraversalRay traversal, inout Found found) {
    bool are_backwards = traversal.direction[order_of_boxes(first)] < 0.0;
    uint passed = 0u;
    [[dont_unroll]] for (;;) {
        iterations++;
        uint place = are_backwards ? count - 1u - passed : passed;
        int entry = entry_of_box(first + 2u * place, traversal);
        if (entry <= end_of(found)) OF_KIND(try_eight)(group + place, entry, traversal, found);
        passed++;
        if (passed == count) break;
    }
}

void OF_KIND(search)(TraversalRay traversal, bool is_searching, inout Found found) {
    if (!is_searching) return;
    uint groups = eighths(frame.counts[KIND]);
    if (LEVELS == 0u) {
        uint group = 0u;
        [[dont_unroll]] for (;;) {
            iterations++;
            OF_KIND(try_eight)(group, 0, traversal, found);
            group++;
            if (group == groups) break;
        }
    } else if (LEVELS == 1u) {
        OF_KIND(try_groups)(first_box_row(KIND), 0u, groups, traversal, found);
    } else {
        Descent descent = descent_of(KIND, LEVELS);
        [[dont_unroll]] for (;;) {
            iterations++;
            uint first, level = next_group(LEVELS, first, descent);
            if (level == 1u) {
                OF_KIND(try_groups)(first, 8u * descent.path, 8u, traversal, found);
            } else {
                bool are_backwards = traversal.direction[order_of_boxes(first)] < 0.0;
                keep(boxes_ahead(first, end_of(found), traversal), are_backwards, level, LEVELS, descent);
            }
            if (is_over(descent) || has_run_out() || found.limit == HIDDEN) break;
        }
    }
}
