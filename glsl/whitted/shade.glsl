// What a hit sends back along the ray: equation 1.19 of the course work without refraction (docs/light-model.md).

// Overflow stops at the largest number, so that no sum becomes infinite or, by inf - inf, NaN.
Real3 limited(Real3 color) { return min(color, Real3(LARGEST)); }

// Of length 1 to some units in the last place.
Real3 mirrored(Real3 direction, Real3 normal) {
    precise Real3 result = direction - (2.0 * dot(direction, normal)) * normal;
    return result;
}

Real fifth_power(Real x) {
    Real square = x * x;
    return square * square * x;
}

// Unit, from a point to a light; not a number where they are one.
Real3 towards(Light light, Real3 point, out Real light_distance) {
    precise Real3 to_light = light.position - point;
    precise Real far = sqrt(dot(to_light, to_light));
    precise Real3 direction = to_light / far;
    light_distance = far;
    return direction;
}

// Whether a light, at this height above the plane of a flat face, is not in it: then a rounded point of the face would
// see it now from above and now from below.
bool is_above(Light light, Hit hit, Real height) {
    Real place = max(largest_component(light.position), largest_component(hit.point));
    return height > SURFACE_ERROR * (place + hit.size);
}

// What of a light that nothing hides comes back along the ray, from a surface at this cosine to it.
Real3 direct_radiance(Material material, Real3 normal, Real3 ray_direction, Real3 light_direction, Real cosine,
                      Light light) {
    Real highlight = 0.0;
    if (HAS_HIGHLIGHTS) {
        Real3 mirrored_light = unit(mirrored(-light_direction, normal));
        highlight = fifth_power(max(-dot(mirrored_light, ray_direction), Real(0.0)));
    }
    Real3 received = (material.diffuse * cosine) * material.color + material.specular * highlight;
    return received * light.intensity;
}
