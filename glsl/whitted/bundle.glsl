// The rays of a packet as one, so that each invocation can try one of eight outlines for all of them: what none of the
// rays can meet need not be tried by each. That pays where trying by ray is dear: cylinders and cones.

// From within `spread` of the origin, at an angle to `direction` of no more than the one with this sine and cosine. About
// the first ray that searches: about the mean of all it would be narrower by less than that takes.
struct Bundle {
    vec3 heading;   // of invocation 0: what lies one behind the other is gone through that way
    vec3 origin;
    vec3 direction; // unit
    float spread;   // with all that rounding may put off; FAR where the rays have no common direction
    float sine;
    float cosine;
};

#if OCTETS
Bundle bundle_of(Beam beam, bool is_searching) {
    uint first = uint(findLSB(bits_of_packet(is_searching ? 1u << gl_SubgroupInvocationID : 0u))) & 7u;
    Bundle bundle;
    bundle.heading = of_packet(beam.direction, 0u);
    bundle.origin = of_packet(beam.origin, first);
    bundle.direction = of_packet(beam.direction, first);
    vec3 from_origin = is_searching ? beam.origin - bundle.origin : vec3(0.0);
    // Twice the sine of half the angle.
    vec3 chord = is_searching ? beam.direction - bundle.direction : vec3(0.0);
    float chord_squared = greatest_of_packet(dot(chord, chord));
    bundle.cosine = 1.0 - 0.5 * chord_squared;
    bundle.sine = sqrt(max(chord_squared * (1.0 - 0.25 * chord_squared), 0.0));
    // Places are off by a few roundings of distances of up to 7 * frame.reach, as much by the directions, and outlines by
    // up to 4 place errors.
    float spread = sqrt(greatest_of_packet(dot(from_origin, from_origin))) + 32.0 * place_error();
    bundle.spread = bundle.cosine > 0.5 ? spread : FAR;
    return bundle;
}

// Of the plane along the bundle's edge that is nearest to a point: no ray goes beyond it by more than the spread.
vec3 edge_normal(Bundle bundle, vec3 point) {
    vec3 from_origin = point - bundle.origin;
    vec3 across = from_origin - dot(from_origin, bundle.direction) * bundle.direction;
    // Once more: of a difference that is small against its terms, much may lie along the direction.
    across -= dot(across, bundle.direction) * bundle.direction;
    vec3 outwards = across / sqrt(max(dot(across, across), 1e-30));
    return bundle.cosine * outwards - bundle.sine * bundle.direction;
}

// Which of the packet's solids, one an invocation, any of its rays may meet before its limit: a bit each. A solid is
// convex and reaches from its middle no farther than its supports along the edge's normal and the bundle's direction.
uint solids_ahead(Bundle bundle, vec3 middle, vec3 normal, float normal_support, float ahead_support, float limit) {
    vec3 from_middle = middle - bundle.origin;
    float ahead = dot(from_middle, bundle.direction);
    bool is_apart = dot(from_middle, normal) - normal_support > bundle.spread;
    bool is_behind = ahead + ahead_support < -bundle.spread;
    int entry = max(floatBitsToInt(ahead - ahead_support - bundle.spread), 0);
    int end = greatest_of_packet(floatBitsToInt(limit));
    return bits_of_packet(is_apart || is_behind || entry > end ? 0u : 1u << gl_SubgroupInvocationID);
}
#else
// Each ray is for itself.
Bundle bundle_of(Beam beam, bool is_searching) {
    return Bundle(beam.direction, beam.origin, beam.direction, 0.0, 0.0, 1.0);
}
#endif
