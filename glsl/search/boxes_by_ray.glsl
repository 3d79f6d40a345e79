// Boxes of a hierarchy for a ray that goes for itself.

int entry_of_box(uint row, TraversalRay traversal) {
    return entry_of_box(texelFetch(proxies, int(row)).xyz, texelFetch(proxies, int(row + 1u)).xyz, traversal);
}

// The axis along which the eight lie one behind the other that begin in row `first`.
uint order_of_boxes(uint first) { return uint(texelFetch(proxies, int(first + 1u)).w); }

// Which of the eight that begin in row `first` the ray enters before the end: a bit each.
uint boxes_ahead(uint first, int end, TraversalRay traversal) {
    uint ahead = 0u;
#define ENTER_ONE(k) ahead |= entry_of_box(first + 2u * k, traversal) > end ? 0u : 1u << k;
    if (MAX_ITERATIONS > 0u) {
        // Where iterations are few, all in one.
        EIGHT_TIMES(ENTER_ONE)
    } else {
        uint k = 0u;
        [[dont_unroll]] for (;;) {
            ENTER_ONE(k)
            k++;
            if (k == 8u) break;
        }
    }
#undef ENTER_ONE
    return ahead;
}

void hold() {}
