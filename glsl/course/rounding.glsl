// The order of rounding in which Mesa's GL ran the course's shader, and so the goldens were made. Where a solid's
// equation is ill-conditioned, a cone's foremost, the last bit of a product decides whether a ray hits; SPIR-V's own
// operations round in another order, and in no order that Vulkan promises.

float dot_(vec3 a, vec3 b) { return a.z * b.z + a.y * b.y + a.x * b.x; }
#define dot dot_

vec3 normalize_(vec3 v) { return v * inversesqrt(dot(v, v)); }
#define normalize normalize_

vec3 reflect_(vec3 I, vec3 N) { return I - 2.0 * dot(N, I) * N; }
#define reflect reflect_

float length_(vec3 v) { return sqrt(dot(v, v)); }
#define length length_

// m·v
vec3 rotate(mat3 m, vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }

// x·scale + offset, rounded once, which GLSL's fma need not be and is not on lavapipe. `x` is a whole number: exact
// for those below 4096, whose product with the upper 12 bits of `scale` has no more than 24 bits.
float fused(float x, float scale, float offset) {
    precise float high = uintBitsToFloat(floatBitsToUint(scale) & 0xFFFFF000u);
    precise float low = scale - high;
    precise float product = x * high;
    precise float sum = product + offset;
    precise float back = sum - product;
    precise float lost = (product - (sum - back)) + (offset - back);
    precise float tail = lost + x * low;
    precise float result = sum + tail;
    return result;
}

// The centre of a pixel in [-1,1]², x to the right, y up (`pixel` counts from the lower left), as a GL rasterizer
// interpolates it over the two triangles of a full-screen quad, cut from the upper left to the lower right.
vec2 windowPoint(uvec2 pixel, uvec2 size) {
    vec2 cell = vec2(pixel), extent = vec2(size);
    precise float per_area = 1.0 / (extent.x * extent.y);
    precise vec2 scale = 2.0 * (extent.yx * per_area);
    precise vec2 offset = 0.5 * scale - 1.0;
    bool upper = (2u * pixel.x + 1u) * size.y + (2u * pixel.y + 1u) * size.x >= 2u * size.x * size.y;
    precise float offset_y = upper ? 1.0 - (extent.y - 0.5) * scale.y : offset.y;
    return vec2(fused(cell.x, scale.x, offset.x), fused(cell.y, scale.y, offset_y));
}
