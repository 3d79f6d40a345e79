#version 460
#extension GL_GOOGLE_include_directive : require
// The accurate kernel's compensated sums and products on pairs of vectors, with what a device's own division, square
// root, fma and tests for NaN and infinity make of them.
layout(local_size_x = 64) in;

#include "common/real.glsl"

struct Pair {
    Real4 a;
    Real4 b;
};

struct Result {
    Real4 sum;
    Real4 sum_error;
    Real4 product;
    Real4 product_error;
    Real4 fma_error; // fma(a, b, -product): the product's error where fma is fused
    Real4 quotient;
    Real4 root;      // of |a|
    Real4 is_nan;      // of a: 1 or 0
    Real4 is_infinite; // of a: 1 or 0
};

layout(binding = 0, std430) readonly buffer Pairs { Pair pairs[]; };
layout(binding = 1, std430) buffer Results { Result results[]; };

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= uint(pairs.length())) return;
    Real3 a = pairs[index].a.xyz;
    Real3 b = pairs[index].b.xyz;
    Sum3 sum = two_sum(a, b);
    Sum3 product = two_product(a, b);
    precise Real3 fma_error = fma(a, b, -product.value);
    precise Real3 quotient = a / b;
    precise Real3 root = sqrt(abs(a));
    results[index] = Result(Real4(sum.value, 0.0), Real4(sum.error, 0.0), Real4(product.value, 0.0),
                            Real4(product.error, 0.0), Real4(fma_error, 0.0), Real4(quotient, 0.0), Real4(root, 0.0),
                            Real4(Real3(isnan(a)), 0.0), Real4(Real3(isinf(a)), 0.0));
}
