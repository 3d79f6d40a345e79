// The random numbers that paths are decided by: pairs of numbers between 0 and 1. They come of integers alone, so that a
// seed gives the same picture on every device but for the rounding of what is calculated from them.
//
// Each decision of a pixel's samples has a sequence of pairs of its own, one pair a sample: the first two dimensions of
// Sobol's, their digits and the order of the pairs scrambled as Owen did, by hashes (Laine and Karras 2011, "Stratified
// sampling for stochastic transparency"; Burley 2020, "Practical hash-based Owen scrambling"). Each 2^m of the pairs,
// counted from a multiple of 2^m, lie one in each of 2^m equal rectangles, whichever way the square is cut into these.
// The pairs of different decisions are joined at random.

// Numbers that know nothing of each other, for comparison.
layout(constant_id = 26) const bool ARE_NUMBERS_INDEPENDENT = false;

// What a sample's numbers depend on, besides the decision.
struct Sequence {
    uint seed;  // of its pixel
    uint index; // of the sample
};

Sequence sequence;

// A bijection whose every output bit depends on every input bit (Wellons 2018, "lowbias32").
uint hashed(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ x >> 16;
}

// Flips each bit or does not by a hash of those below it: Owen's scrambling of a fraction whose first digit is the
// lowest bit. A product by an even number and a sum carry from lower bits to higher ones only. (Constants: Vegdahl 2021.)
uint scrambled(uint digits, uint seed) {
    digits ^= digits * 0x3d20adeau;
    digits += seed;
    digits *= seed >> 16 | 1u;
    digits ^= digits * 0x05526c56u;
    return digits ^ digits * 0x53a22864u;
}

// Sobol's second dimension of an index, its first digit the lowest bit: digit r is the sum modulo 2 of the index's bits
// j, times the binomial coefficient of j over r, which is odd where all bits of r are in j (Lucas).
uint second_dimension(uint index) {
    index ^= index >> 1 & 0x55555555u;
    index ^= index >> 2 & 0x33333333u;
    index ^= index >> 4 & 0x0F0F0F0Fu;
    index ^= index >> 8 & 0x00FF00FFu;
    return index ^ index >> 16 & 0x0000FFFFu;
}

// Between 0 and 1, and neither: all of it is exact in a float.
Real fraction(uint bits) { return Real((float(bits >> 9) + 0.5) * 1.1920928955078125e-7); }

// The pair of the sample for a decision.
Real2 pair(uint decision) {
    uint seed = hashed(sequence.seed ^ hashed(decision));
    if (ARE_NUMBERS_INDEPENDENT) {
        uint first = hashed(seed + 0x9E3779B9u * sequence.index);
        return Real2(fraction(first), fraction(hashed(first ^ 0x85EBCA6Bu)));
    }
    uint place = bitfieldReverse(scrambled(bitfieldReverse(sequence.index), seed));
    uint first = scrambled(place, hashed(seed + 1u)), second = scrambled(second_dimension(place), hashed(seed + 2u));
    return Real2(fraction(bitfieldReverse(first)), fraction(bitfieldReverse(second)));
}
