// A primary ray through all its generations.

// The ray through the centre of a pixel counted from the top left.
Ray primary_ray(uvec2 pixel, uvec2 size, View view) {
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
    return Ray(view.position, view.position_error, unit(direction));
}

// Where the ray meets the nearest ball of a light, and its intensity; at LARGEST, nothing.
Real light_ball_ahead(Ray ray, out Real3 intensity) {
    intensity = Real3(0.0);
    Real t = LARGEST;
    uint i = 0u;
    for (;;) {
        turns++;
        Light light = light(i);
        Hit ball;
        bool is_met = meet(Sphere(light.position, light.ball_radius), ray, FREE, CURVED, ball);
        bool is_seen = i < frame.light_count && is_met && ball.t < t;
        if (is_seen) intensity = light.intensity;
        t = is_seen ? ball.t : t;
        i++;
        if (BALLS == 1u || !(i < frame.light_count)) break;
    }
    return t;
}

// What a ray is cast for.
const uint ENDED = 0u;
const uint TO_NEAREST = 1u;
const uint TO_LIGHT = 2u;

// A bound for what lies at or before t, from the exact t.
float up_to(Real t) { return float(min(t, Real(FAR))) * (1.0 + 4.0 * FLOAT_ROUNDOFF); }

// Linear RGB. Every turn of the loop looks for one candidate on one ray and solves that: rays of all generations, to the
// nearest hit and to lights, go the same way, so that neighbours in different stages do not wait for each other, and one
// exact solve stands in the code. `is_there`: whether the ray counts.
Real3 trace(Ray ray, bool is_there, Real3 background) {
    Real3 color = Real3(0.0);
    Real weight = 1.0;
    uint generation = 0u;
    uint purpose = is_there ? TO_NEAREST : ENDED;
    Departure departure = Departure(NOTHING, CURVED, false);
    Real3 ball_intensity = Real3(0.0);
    Real ball_t = LARGEST;
    if (BALLS > 0u) ball_t = light_ball_ahead(ray, ball_intensity);

    // The nearest hit so far of the ray, and then what its lights add up to.
    Hit nearest;
    Material matter;
    Real3 emitted, ray_direction = ray.direction;
    uint light_index = 0u; // of the first light that has not been tried
    Light lamp;
    // The only one is read once.
    if (LIGHTS == 1u) lamp = light(0u);
    Real light_distance;
    Real3 light_direction;
    Real3 sent; // back along the ray, of what the lamp gives
    bool is_hit = false;

    // Where the search stands.
    float limit = FAR;
    uint after_key = 0u;
    int after_group = -1;
    bool is_own_due = false; // the solid that the ray leaves inwards is to be solved first

    for (;;) {
        turns++;
        Beam beam = beam_of(ray);
        beam.skipped = departure.slot;
        beam.after_key = after_key;
        beam.after_group = after_group;
        bool is_shadow_ray = HAS_SHADOWS && purpose == TO_LIGHT;
        beam.target_size = is_shadow_ray ? float(min(largest_component(lamp.position), Real(FAR))) : -1.0;
        Found found = next_candidate(beam, limit, purpose != ENDED && !is_own_due);
        bool is_hidden = is_shadow_ray && !is_own_due && found.limit == HIDDEN;
        uint last_key = uint(floatBitsToInt(limit)) | 7u;
        bool is_candidate = is_own_due || (found.key <= last_key && !is_hidden);

        Hit hit;
        uint found_slot = 8u * uint(found.group) + (found.key & 7u);
        uint slot = is_own_due ? departure.slot : (is_candidate ? found_slot : 0u);
        bool is_met = meet(slot, ray, departure, hit) && is_candidate;
        Material met = material(slot);
        if (purpose == TO_NEAREST && is_met &&
            (!is_hit || is_nearer(hit, met.primitive, nearest, matter.primitive, ray))) {
            nearest = hit;
            matter = met;
            is_hit = true;
            limit = up_to(hit.t);
        }
        if (HAS_SHADOWS) {
            bool is_met_before = is_shadow_ray && is_met && is_before(hit, ray, lamp.position, light_distance);
            is_hidden = is_hidden || is_met_before;
        }
        // Whether another candidate may come before what is known.
        last_key = uint(floatBitsToInt(limit)) | 7u;
        bool goes_on = is_candidate && !is_hidden && (is_own_due || found.next_key <= last_key);
        after_key = is_own_due ? 0u : found.key;
        after_group = is_own_due ? -1 : found.group;
        is_own_due = false;

        // The ray has come to its end: what it brings, and what comes next.
        bool is_done = purpose != ENDED && !goes_on;
        bool is_last = is_done && !is_shadow_ray && (!is_hit || (generation == 0u && ball_t < nearest.t));
        if (is_done && is_shadow_ray && !is_hidden) emitted = limited(emitted + sent);
        if (is_last) {
            Real3 seen = generation == 0u && ball_t < LARGEST ? ball_intensity : background;
            color = limited(color + weight * seen);
        }
        if (is_done && !is_shadow_ray) {
            light_index = 0u;
            if (!is_last) {
                departure = Departure(nearest.slot, nearest.face, nearest.inside);
                emitted = matter.ambient * matter.color;
                ray_direction = ray.direction;
            }
        }

        // On to the next light that a shadow ray is worth. A packet's rays stay together here, and read no light beyond the
        // last, which would be undefined: as a loop within the branch of those that are done, reading one too many, Mesa
        // 22.3 drew tests/scenes/three_lights.toml wrong. Either change alone cures that; what it came from is not known.
        bool is_lit = false;
        if (LIGHTS > 0u) {
            bool is_seeking = is_done && !is_last && light_index < frame.light_count;
            for (;;) {
                turns++;
                Light next = lamp;
                if (LIGHTS > 1u) next = light(min(light_index, frame.light_count - 1u));
                Real distance_to_next;
                Real3 direction_to_next = towards(next, nearest.point, distance_to_next);
                Real cosine = dot(nearest.normal, direction_to_next);
                // A light at the hit point gives nothing.
                bool shines = is_seeking && distance_to_next > 0.0 && cosine > 0.0;
                Real3 sent_by_next = sent_back(matter, nearest.normal, ray_direction, direction_to_next, cosine, next);
                // Too little for a shadow ray: half of it is off by half of it, whatever is in the way.
                bool is_faint = weight * largest_component(sent_by_next) <= Real(frame.least_shadowed);
                if (HAS_SHADOWS && shines && !is_faint) {
                    is_lit = true;
                    lamp = next;
                    light_distance = distance_to_next;
                    light_direction = direction_to_next;
                    sent = sent_by_next;
                } else if (shines) {
                    emitted = limited(emitted + (is_faint ? Real3(0.5) * sent_by_next : sent_by_next));
                }
                light_index += is_seeking ? 1u : 0u;
                is_seeking = is_seeking && !is_lit && light_index < frame.light_count;
                if (LIGHTS == 1u || !any_of_packet(is_seeking)) break;
            }
        }

        if (is_done) {
            is_own_due = departure.inside;
            after_key = 0u;
            after_group = -1;
        }
        if (is_lit) {
            ray = Ray(nearest.point, Real3(0.0), light_direction);
            purpose = TO_LIGHT;
            limit = up_to(light_distance);
        } else if (is_done) {
            if (!is_last) color = limited(color + weight * emitted);
            purpose = ENDED;
            if (HAS_REFLECTIONS) {
                weight *= matter.specular;
                generation++;
                bool goes_further = weight > Real(frame.least_weight) && generation < frame.depth && !is_last;
                purpose = goes_further ? TO_NEAREST : ENDED;
                ray = Ray(nearest.point, Real3(0.0), reflected(ray_direction, nearest.normal));
                limit = FAR;
                is_hit = false;
            }
        }
        if (!(any_of_packet(purpose != ENDED) && turns < LOOP_TURNS)) break;
    }
    return color;
}
