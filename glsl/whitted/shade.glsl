// What a hit sends back along the ray: equation 1.19 of the course work without refraction (DESIGN.md).

// Overflow stops at the largest number, so that no sum becomes infinite or, by inf - inf, NaN.
Real3 limited(Real3 color) { return min(color, Real3(LARGEST)); }

Real3 reflected(Real3 direction, Real3 normal) {
    precise Real3 result = direction - (2.0 * dot(direction, normal)) * normal;
    return unit(result);
}

Real fifth_power(Real x) {
    Real square = x * x;
    return square * square * x;
}

// No means that there are none, or that the plan has left them out.
layout(constant_id = 8) const bool HAS_HIGHLIGHTS = true;

// Linear RGB, without reflections; `weight` is that of the ray.
Real3 emitted(Hit hit, Real3 ray_direction, Material material, Departure departure, Real weight, Ranges ranges) {
    Real least_shadowed = Real(frame.least_shadowed);
    Real3 sum = material.ambient * material.color;
    for (uint i = 0u; i < frame.light_count; i++) {
        turns++;
        Light light = lights[i];
        precise Real3 to_light = light.position - hit.point;
        Real distance = sqrt(dot(to_light, to_light));
        // A light at the hit point gives nothing.
        if (!(distance > 0.0)) continue;
        precise Real3 light_direction = to_light / distance;
        precise Real cosine = dot(hit.normal, light_direction);
        if (!(cosine > 0.0)) continue;
        Real highlight = 0.0;
        if (HAS_HIGHLIGHTS) {
            Real3 mirrored_light = reflected(-light_direction, hit.normal);
            highlight = fifth_power(max(-dot(mirrored_light, ray_direction), Real(0.0)));
        }
        Real3 received = (material.diffuse * cosine) * material.color + material.specular * highlight;
        Real3 sent = received * light.intensity;
        // Too little for a shadow ray: half of it is off by half of it, whatever is in the way.
        if (weight * largest_component(sent) <= least_shadowed) sent *= 0.5;
        else if (is_hidden(Ray(hit.point, light_direction), departure, light.position, distance, ranges)) continue;
        sum = limited(sum + sent);
    }
    return sum;
}
