// What a hit sends back along the ray, and where rays go on: equation 1.19 of the course work (docs/light-model.md).

// Lights that are told apart where a bit is kept of each that reaches a point; those beyond share the last.
const uint LIT_BITS = 27u;

// Overflow stops at the largest number, so that no sum becomes infinite or, by inf - inf, NaN.
Real3 limited(Real3 color) { return min(color, Real3(LARGEST)); }

// Mirrored direction, of length 1 to some units in the last place.
Real3 mirrored(Real3 direction, Real3 normal) {
    precise Real3 result = direction - (2.0 * dot(direction, normal)) * normal;
    return result;
}

Real fifth_power(Real x) {
    Real square = x * x;
    return square * square * x;
}

// x to the power of n_256 / 256, for x from 0 to 1, by squares and square roots: `pow` is coarse, and there is none of
// doubles. The relative error is about that of x times the exponent.
Real power(Real x, uint n_256) {
    Real result = 1.0, square = x, root = x;
    uint whole = n_256 >> 8u;
    [[unroll]] for (uint bit = 0u; bit <= 10u; bit++) {
        result *= (whole >> bit & 1u) != 0u ? square : Real(1.0);
        square *= square;
    }
    [[unroll]] for (uint bit = 1u; bit <= 8u; bit++) {
        root = sqrt(root);
        result *= (n_256 >> (8u - bit) & 1u) != 0u ? root : Real(1.0);
    }
    return result;
}

// The direction of the refracted ray by Snell's law, for a unit direction and a unit normal towards the side that it
// comes from; refractive indices of that side and of the other. False where all is reflected.
//
// With r = from / to and c the cosine here, the cosine there is
// sqrt(1 - r^2 * (1 - c^2)) = sqrt((r * c)^2 - (r^2 - 1)),
// and the direction r * d + (r * c - cosine there) * n. Nothing cancels: a difference of squares is a product, that of
// r * c and the cosine there is the quotient of r^2 - 1 and their sum, and r^2 - 1 comes from the indices' difference.
bool refracted(Real3 direction, Real3 normal, Real from, Real to, out Real3 result) {
    result = direction;
    if (from == to) return true;
    precise Real ratio = from / to;
    precise Real excess = (from - to) * (from + to) / (to * to);
    Real cosine = max(-dot(direction, normal), Real(0.0));
    precise Real near = ratio * cosine;
    Real root = sqrt(max(excess, Real(0.0)));
    precise Real squared = excess > 0.0 ? (near - root) * (near + root) : near * near - excess;
    if (squared < 0.0) return false;
    precise Real across = excess / (near + sqrt(squared));
    precise Real3 sum = ratio * direction + across * normal;
    result = unit(sum);
    return true;
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
Real3 direct_radiance(Material material, Real3 normal, Real3 ray_direction, Real3 light_direction, Real light_distance,
                      Real cosine, Light light) {
    Real highlight = 0.0;
    if (HAS_HIGHLIGHTS) {
        Real3 mirrored_light = unit(mirrored(-light_direction, normal));
        Real alignment = max(-dot(mirrored_light, ray_direction), Real(0.0));
        if (HAS_SHININESS) {
            highlight = power(alignment, material.shininess_256);
        } else {
            highlight = fifth_power(alignment);
        }
    }
    Real3 received = (material.diffuse * cosine) * material.color + material.specular * highlight;
    Real3 intensity = light.intensity;
    if (HAS_ATTENUATION) intensity *= light.scale / (light.slope * light_distance + light.constant);
    Real3 radiance = received * intensity;
    // What is to be weakened on its way must be a number.
    if (HAS_ATTENUATION || MEDIA != NO_MEDIA) radiance = limited(radiance);
    return radiance;
}
