// The two pieces that the listings call or need without showing them.

// The mirror ray, started 0.02 off the surface.
Ray calculateReflected(Ray ray, Intersection hit) {
    return Ray(hit.point + 0.02 * hit.normal, normalize(reflect(ray.direction, hit.normal)));
}

// x·scale + offset, rounded once: lavapipe splits `fma`. `x` is a whole number below 4096.
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

// The point of the picture in [-1,1]², y up, as GL interpolates it over two triangles that share the diagonal from the
// upper left to the lower right.
vec2 windowPoint(uvec2 pixel, uvec2 size) {
    vec2 cell = vec2(pixel), extent = vec2(size);
    precise float per_area = 1.0 / (extent.x * extent.y);
    precise vec2 scale = 2.0 * (extent.yx * per_area);
    precise vec2 offset = 0.5 * scale - 1.0;
    bool upper = (2u * pixel.x + 1u) * size.y + (2u * pixel.y + 1u) * size.x >= 2u * size.x * size.y;
    precise float offset_y = upper ? 1.0 - (extent.y - 0.5) * scale.y : offset.y;
    return vec2(fused(cell.x, scale.x, offset.x), fused(cell.y, scale.y, offset_y));
}

// The ray through a point `q` of the picture in [-1,1]², x to the right, y up. Normalized twice, as the course did.
// The course fed a formula meant for [0,1]² with [-1,1]², which shifts the window: see Projection::Course.
Ray primaryRay(vec2 q, float aspect) {
    vec2 p = frame.window_low < 0.0 ? q : 0.5 * q + 0.5;
    float a = (1.0 - 2.0 * p.x) * aspect * frame.half_fov_tangent;
    float b = (2.0 * p.y - 1.0) * frame.half_fov_tangent;
    vec3 local = normalize(vec3(a, b, -1.0));
    precise vec3 world = local.x * frame.camera_s + local.y * frame.camera_u + local.z * frame.camera_f;
    return Ray(frame.camera_position, normalize(world));
}
