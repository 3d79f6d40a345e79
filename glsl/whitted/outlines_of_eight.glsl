// The eight outlines of a group, and what a packet finds out about them before it tries them.

// The rows from which the invocation hands its packet one of eight outlines.
struct OwnOutline {
    uint first; // row of the group
    vec4 a;
    vec4 b;
};

// Of a group of the kind whose outlines begin at a row.
OwnOutline own_outline(uint kind_first, uint group, uint rows) {
    uint first = kind_first + 8u * rows * group;
    vec4 a = OWN_ROW(outlines, first, rows);
    vec4 b = vec4(0.0);
    if (rows > 1u) b = OWN_ROW(outlines, first + 1u, rows);
    return OwnOutline(first, a, b);
}

#if OCTETS
// Which of the packet's balls, one an invocation, a ray that searches meets: a bit each.
uint balls_ahead(vec4 own, Beam beam, bool is_searching) {
    uint ahead = 0u;
#define TRY_BALL(k) ahead |= ~uint(misses_ball(subgroupShuffle(own, k), beam)) & (1u << k);
    EIGHT_TIMES(TRY_BALL)
#undef TRY_BALL
    return bits_of_packet(is_searching ? ahead : 0u);
}
#endif
