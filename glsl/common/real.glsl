// The kernel's numbers, float or double as the build says (REAL_BITS), and sums and products without rounding errors.
//
// Without COMPENSATION, for comparison, sums and products are the device's own and solids are met by the textbook's
// quadratics, from the ray's own origin.
//
// `precise` keeps the compiler from contracting and reassociating. It does not reach into called functions, so every
// helper marks its own variables.

#if REAL_BITS == 64
#define Real double
#define Real2 dvec2
#define Real3 dvec3
#define Real4 dvec4
// Half the distance from 1 to the next number.
const Real UNIT_ROUNDOFF = 1.1102230246251565e-16LF;
// 2^27 + 1: cuts 53 bits in two halves.
const Real SPLITTER = 134217729.0LF;
const Real LARGEST = 1.7976931348623157e308LF;
// A row of four reals from a texel buffer.
#define Rows usamplerBuffer
#define ROW(rows, index) of_two_texels(texelFetch(rows, int(2u * (index))), texelFetch(rows, int(2u * (index) + 1u)))
Real4 of_two_texels(uvec4 xy, uvec4 zw) {
    return Real4(packDouble2x32(xy.xy), packDouble2x32(xy.zw), packDouble2x32(zw.xy), packDouble2x32(zw.zw));
}
#else
#define Real float
#define Real2 vec2
#define Real3 vec3
#define Real4 vec4
const Real UNIT_ROUNDOFF = 5.9604644775390625e-8;
// 2^12 + 1: cuts 24 bits in two halves.
const Real SPLITTER = 4097.0;
const Real LARGEST = 3.4028234663852886e38;
// A row of four reals from a texel buffer.
#define Rows samplerBuffer
#define ROW(rows, index) texelFetch(rows, int(index))
#endif

// Whether the device rounds a fma once, which neither Vulkan nor GLSL promises.
layout(constant_id = 0) const bool HAS_FUSED_FMA = false;

// value + error, with |error| <= ulp(value)/2 after `renormalized`.
struct Sum3 {
    Real3 value;
    Real3 error;
};

// a + b exactly (Knuth's TwoSum).
Sum3 two_sum(Real3 a, Real3 b) {
    precise Real3 sum = a + b;
#if COMPENSATION
    precise Real3 b_part = sum - a;
    precise Real3 a_part = sum - b_part;
    precise Real3 error = (a - a_part) + (b - b_part);
    return Sum3(sum, error);
#else
    return Sum3(sum, Real3(0.0));
#endif
}

// a + b exactly, where |a| >= |b| (Dekker's Fast2Sum).
Sum3 renormalized(Real3 a, Real3 b) {
    precise Real3 sum = a + b;
    precise Real3 error = b - (sum - a);
    return Sum3(sum, error);
}

// Upper half of each component's bits (Veltkamp), safe below LARGEST / SPLITTER.
Real3 upper_half(Real3 a) {
    precise Real3 scaled = SPLITTER * a;
    precise Real3 upper = scaled - (scaled - a);
    return upper;
}

// a * b exactly (TwoProd: by a fused fma, else Dekker's).
Sum3 two_product(Real3 a, Real3 b) {
    precise Real3 product = a * b;
    precise Real3 error = Real3(0.0);
#if COMPENSATION
    if (HAS_FUSED_FMA) {
        error = fma(a, b, -product);
    } else {
        precise Real3 a_upper = upper_half(a);
        precise Real3 b_upper = upper_half(b);
        precise Real3 a_lower = a - a_upper;
        precise Real3 b_lower = b - b_upper;
        error = ((a_upper * b_upper - product) + a_upper * b_lower + a_lower * b_upper) + a_lower * b_lower;
    }
#endif
    return Sum3(product, error);
}

#if COMPENSATION
// start + factor * (vector + vector_error), with an error of about u^2 of the largest term.
Sum3 add_scaled(Sum3 start, Real factor, Real3 vector, Real3 vector_error) {
    Sum3 product = two_product(Real3(factor), vector);
    Sum3 sum = two_sum(start.value, product.value);
    precise Real3 rest = sum.error + ((start.error + product.error) + factor * vector_error);
    return renormalized(sum.value, rest);
}

// a + b + c + rest, rounded about once, where `rest` is some u of the others.
Real exact_sum(Real a, Real b, Real c, Real rest) {
    precise Real bc = b + c;
    precise Real c_part = bc - b;
    precise Real bc_error = (b - (bc - c_part)) + (c - c_part);
    precise Real abc = a + bc;
    precise Real bc_part = abc - a;
    precise Real abc_error = (a - (abc - bc_part)) + (bc - bc_part);
    precise Real result = abc + ((abc_error + bc_error) + rest);
    return result;
}

// (a + a_error) . (b.value + b.error), rounded about once (Dot2 of Ogita, Rump and Oishi).
Real exact_dot(Real3 a, Real3 a_error, Sum3 b) {
    Sum3 product = two_product(a, b.value);
    precise Real xy = product.value.x + product.value.y;
    precise Real y_part = xy - product.value.x;
    precise Real xy_error = (product.value.x - (xy - y_part)) + (product.value.y - y_part);
    precise Real xyz = xy + product.value.z;
    precise Real z_part = xyz - xy;
    precise Real xyz_error = (xy - (xyz - z_part)) + (product.value.z - z_part);
    precise Real rest = (product.error.x + product.error.y + product.error.z) + (xy_error + xyz_error);
    precise Real beyond = dot(a, b.error) + dot(a_error, b.value);
    precise Real result = xyz + (rest + beyond);
    return result;
}
#else
Sum3 add_scaled(Sum3 start, Real factor, Real3 vector, Real3 vector_error) {
    return Sum3(start.value + factor * vector, Real3(0.0));
}

Real exact_sum(Real a, Real b, Real c, Real rest) { return a + b + c; }

Real exact_dot(Real3 a, Real3 a_error, Sum3 b) { return dot(a, b.value); }
#endif

Real largest_component(Real3 v) {
    Real3 size = abs(v);
    return max(size.x, max(size.y, size.z));
}

// Unit vector along one whose square is a normal number. `inversesqrt` is left out: a device may make it coarse.
Real3 unit(Real3 v) {
    precise Real3 result = v / sqrt(dot(v, v));
    return result;
}
