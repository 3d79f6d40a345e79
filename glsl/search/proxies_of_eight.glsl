// The eight proxies of a group, and what a packet finds out about them before it tests them.

// The rows from which the invocation hands its packet one of eight proxies.
struct OwnOutline {
    vec4 a;
    vec4 b;
};

// Outline of the invocation's own proxy in a group of the kind whose proxies begin at a row.
OwnOutline own_outline(uint kind_first, uint group, uint rows) {
    uint first = kind_first + 8u * rows * group;
    vec4 a = OWN_ROW(proxies, first, rows);
    vec4 b = vec4(0.0);
    if (rows > 1u) b = OWN_ROW(proxies, first + 1u, rows);
    return OwnOutline(a, b);
}

// Which of the packet's bounding spheres, one an invocation, a ray that searches meets: a bit each.
uint bounding_spheres_ahead(vec4 own, TraversalRay traversal, bool is_searching) {
    uint ahead = 0u;
#define TRY_SPHERE(k) ahead |= ~uint(misses_sphere(subgroupShuffle(own, k), traversal)) & (1u << k);
    EIGHT_TIMES(TRY_SPHERE)
#undef TRY_SPHERE
    return bits_of_packet(is_searching ? ahead : 0u);
}
