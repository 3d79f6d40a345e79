// The balls of lights, which primary rays see.

// Whether the ray may meet the ball: in float, on the safe side. Lights may lie beyond frame.reach, so that the rounding of
// their centres goes by the distance too: u of it, and u more for that of a double's direction, besides the 16u of
// DISTANCE_ERROR.
bool may_meet_ball(Ray ray, Light light) {
    vec3 to_center = vec3(light.position) - vec3(ray.origin), direction = vec3(ray.direction);
    float ahead = dot(to_center, direction);
    vec3 across = to_center - ahead * direction;
    float radius = float(light.ball_radius);
    radius += (2.0 * DISTANCE_ERROR) * (abs(ahead) + radius) + place_error();
    return dot(across, across) <= radius * radius && ahead >= -radius;
}

// `lamp`: the only one, where there is but one.
Light light_with_ball(uint index, Light lamp) {
    if (BALLS > 1u) return light(index);
    return lamp;
}

// Of any light.
bool may_meet_a_ball(Ray ray, Light lamp) {
    bool may_meet = false;
    uint i = 0u;
    for (;;) {
        turns++;
        may_meet = may_meet || may_meet_ball(ray, light_with_ball(i, lamp));
        i++;
        if (BALLS == 1u || !(i < frame.light_count)) break;
    }
    return may_meet;
}

// Where the ray meets the nearest ball of a light, and its intensity; at LARGEST, nothing. Of a ray that does not look for
// balls, nothing is told, and it takes a single turn.
Real ball_ahead(Ray ray, Light lamp, bool looks, out Real3 intensity) {
    intensity = Real3(0.0);
    Real t = LARGEST;
    uint i = 0u;
    for (;;) {
        turns++;
        Light ball_light = light_with_ball(i, lamp);
        Hit ball;
        // In a close-up about its centre, as there is nothing that touches it.
        Sphere sphere = Sphere(ball_light.position, ball_light.ball_radius, Real3(0.0), -0.5 * ball_light.ball_radius, Real3(0.0));
        bool is_met = meet(sphere, ray, FREE, CURVED, ball);
        // From within there is nothing to see of it, nor of one without a radius.
        bool is_there = ball_light.ball_radius > 0.0 && !ball.inside;
        bool is_seen = i < frame.light_count && is_met && is_there && ball.t < t;
        if (is_seen) intensity = ball_light.intensity;
        t = is_seen ? ball.t : t;
        i++;
        if (BALLS == 1u || !(i < frame.light_count && any_of_packet(looks))) break;
    }
    return t;
}
