// Light spheres, which primary rays see.

// Whether the ray may meet the light sphere: in float, conservatively. Lights may lie beyond frame.reach, so that the
// rounding of their centres scales with the distance too: u of it, and u more for that of a double's direction, besides
// the 16u of DISTANCE_ERROR.
bool may_meet_light_sphere(Ray ray, Light light) {
    vec3 to_center = vec3(light.position) - vec3(ray.origin), direction = vec3(ray.direction);
    float ahead = dot(to_center, direction);
    vec3 across = to_center - ahead * direction;
    float radius = float(light.sphere_radius);
    radius += (2.0 * DISTANCE_ERROR) * (abs(ahead) + radius) + place_error();
    return dot(across, across) <= radius * radius && ahead >= -radius;
}

// `current_light`: the only one, where there is but one and packets hold it.
Light light_with_sphere(uint index, Light current_light) {
    if (LIGHT_SPHERES > 1u || !IN_PACKETS) return light(index);
    return current_light;
}

// The same of any light.
bool may_meet_a_light_sphere(Ray ray, Light current_light) {
    bool may_meet = false;
    uint i = 0u;
    for (;;) {
        iterations++;
        may_meet = may_meet || may_meet_light_sphere(ray, light_with_sphere(i, current_light));
        i++;
        if (LIGHT_SPHERES == 1u || !(i < frame.light_sphere_count)) break;
    }
    return may_meet;
}

// Where the ray meets the nearest light sphere, and its intensity; at LARGEST, nothing. Of a ray that does not look for
// light spheres, nothing is reported, and it takes a single iteration.
Real light_sphere_ahead(Ray ray, Light current_light, bool looks, out Real3 intensity) {
    intensity = Real3(0.0);
    Real t = LARGEST;
    uint i = 0u;
    for (;;) {
        iterations++;
        Light sphere_light = light_with_sphere(i, current_light);
        Hit light_sphere;
        // Relative to its centre in a close-up, too.
        Curve about_center = Curve(Real3(0.0), -0.5 * sphere_light.sphere_radius, Real3(0.0));
        Sphere sphere = Sphere(sphere_light.position, sphere_light.sphere_radius, about_center);
        bool is_met = meet(sphere, ray, FREE, CURVED, light_sphere);
        // From within there is nothing to see of it, nor of one without a radius.
        bool is_there = sphere_light.sphere_radius > 0.0 && !light_sphere.inside;
        bool is_seen = i < frame.light_sphere_count && is_met && is_there && light_sphere.t < t;
        if (is_seen) intensity = sphere_light.intensity;
        t = is_seen ? light_sphere.t : t;
        i++;
        if (LIGHT_SPHERES == 1u || !(i < frame.light_sphere_count && any_of_packet(looks))) break;
    }
    return t;
}
