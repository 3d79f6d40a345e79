// A primary ray through all its generations.

// The ray through the centre of a pixel counted from the top left; the camera is the kernel frame's origin.
Ray primary_ray(uvec2 pixel, uvec2 size) {
    // Twice the pixel centre is a whole number: exact.
    precise Real x = Real(2u * pixel.x + 1u) / Real(2u * size.x);
    precise Real y = Real(2u * (size.y - 1u - pixel.y) + 1u) / Real(2u * size.y);
    // x right, y up, in [0, 1]^2: what the camera formula was written for. The course feeds it [-1, 1]^2.
    bool is_course = view.window_low < 0.0;
    precise Real window_x = is_course ? 2.0 * x - 1.0 : x;
    precise Real window_y = is_course ? 2.0 * y - 1.0 : y;
    precise Real to_left = (1.0 - 2.0 * window_x) * view.half_width;
    precise Real upward = (2.0 * window_y - 1.0) * view.half_height;
    precise Real3 direction = view.left * to_left + view.up * upward + view.ahead;
    return Ray(Real3(0.0), unit(direction));
}

// The light whose ball is nearer than the hit, or NOTHING.
uint light_ball_before(Ray ray, Hit hit) {
    uint seen = NOTHING;
    Real limit = hit.slot == NOTHING ? LARGEST : hit.t;
    for (uint i = 0u; i < frame.light_count; i++) {
        Hit ball;
        bool is_met = meet(Sphere(lights[i].position, lights[i].ball_radius), ray, FREE, CURVED, ball);
        if (is_met && ball.t < limit) {
            seen = i;
            limit = ball.t;
        }
    }
    return seen;
}

// Linear RGB.
Real3 trace(Ray ray, Ranges ranges) {
    Departure departure = Departure(NOTHING, CURVED, false);
    Real weight = 1.0;
    Real3 color = Real3(0.0);
    Real least_weight = Real(frame.least_weight);
    for (uint generation = 0u; generation < frame.depth && weight > least_weight && turns < LOOP_TURNS; generation++) {
        turns++;
        Hit hit = nearest_hit(ray, departure, ranges);
        uint ball = generation == 0u ? light_ball_before(ray, hit) : NOTHING;
        bool ends = ball != NOTHING || hit.slot == NOTHING;
        if (ends) {
            Real3 seen = ball != NOTHING ? lights[ball].intensity : view.background;
            color = limited(color + weight * seen);
            weight = 0.0;
        } else {
            Material material = materials[hit.slot];
            departure = Departure(hit.slot, hit.face, hit.inside);
            color = limited(color + weight * emitted(hit, ray.direction, material, departure, weight, ranges));
            weight *= material.specular;
            ray = Ray(hit.point, reflected(ray.direction, hit.normal));
        }
    }
    return color;
}
