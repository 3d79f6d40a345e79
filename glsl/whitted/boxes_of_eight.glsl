// Eight boxes of a hierarchy's level.

// Which of them the ray, or any of its packet, may meet before its limit: a bit each. `order`: the axis along which they
// lie one behind the other.
uint boxes_met(uint first, Beam beam, float limit, out uint order) {
    vec4 own_middle = OWN_ROW(outlines, first, 2u);
    vec4 own_half = OWN_ROW(outlines, first + 1u, 2u);
    vec3 steepness = abs(beam.inverse);
    int end = floatBitsToInt(limit);
    uint met = 0u;
#define MEET_ONE(k)                                                                                      \
    {                                                                                                    \
        vec3 at = (ROW_OF_EIGHT(own_middle, outlines, first, 2u, k).xyz - beam.origin) * beam.inverse;   \
        vec3 reach = ROW_OF_EIGHT(own_half, outlines, first + 1u, 2u, k).xyz * steepness;                \
        ivec3 enters = floatBitsToInt(at - reach), leaves = floatBitsToInt(at + reach);                  \
        int near = max(max(enters.x, enters.y), max(enters.z, 0));                                       \
        int far = min(min(leaves.x, leaves.y), min(leaves.z, end));                                      \
        met |= near > far ? 0u : 1u << k;                                                                \
    }
    EIGHT_TIMES(MEET_ONE)
#undef MEET_ONE
    order = uint(ROW_OF_EIGHT(own_half, outlines, first + 1u, 2u, 0u).w);
    return bits_of_packet(met);
}

// Groups of eight that so many are, and all that these have room for.
uint eighths(uint count) { return (count + 7u) >> 3; }
uint padded(uint count) { return eighths(count) << 3; }
