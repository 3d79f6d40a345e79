// Primary rays through all their generations.

// What a ray is cast for.
const uint ENDED = 0u;
const uint TO_NEAREST = 1u;
const uint TO_LIGHT = 2u;
const uint REFLECTED = 3u; // to the nearest, and not yet made of the hit that it leaves

// A bound for what lies at or before t, from the exact t.
float up_to(Real t) { return float(min(t, Real(FAR))) * (1.0 + 4.0 * FLOAT_ROUNDOFF); }

// What a primary ray becomes.
struct Path {
    Real3 color;     // linear RGB, of the generations that are over
    Real weight;     // in it, of the present one
    uint generation;
};

// A generation is over that brings `local_radiance`. Tells what the next ray is cast for.
uint next_bounce(Real3 local_radiance, bool is_hit, Real specular, inout Path path) {
    path.color = limited(path.color + path.weight * local_radiance);
    path.weight *= specular;
    path.generation++;
    bool goes_further = is_hit && path.weight > Real(frame.min_throughput) && path.generation < frame.depth;
    return HAS_REFLECTIONS && goes_further ? REFLECTED : ENDED;
}

// Rays of all generations, to the nearest hit and to lights, go the same way, so that neighbours in different stages do
// not wait for each other, and one exact solve stands in the code. The search, which every ray needs, is the inner
// loop; what only a ray with a candidate or a hit needs is gone through when some ray of the packet is there. A packet
// whose rays all came to their end goes on to its next pixels in that loop too: at the end of each pixel the rest would
// be gone through for nobody.
void trace(View view) {
    uint begun = 0u; // of the invocation's pixels
    Path path = Path(Real3(0.0), 1.0, 0u);
    uint purpose = ENDED;
    bool is_packet_at_rest = true;
    Ray ray = Ray(view.position, view.position_error, view.ahead);
    OriginSurface origin_surface = OriginSurface(NOTHING, CURVED, false);
    bool may_see_light_sphere = false; // a primary ray that may

    // The nearest hit so far of the ray, and then what its lights add up to.
    Hit nearest;
    Material hit_material;
    Real3 local_radiance = Real3(0.0), ray_direction = ray.direction;
    uint light_index = 0u; // of the first light that has not been tried
    Light current_light;
    // The only one is read once.
    if (LIGHTS == 1u || LIGHT_SPHERES == 1u) current_light = light(0u);
    Real light_distance;
    Real3 direct; // back along the ray, of what the current light gives
    bool is_hit = false;

    // Where the search stands.
    hold_boxes();
    float limit = FAR;
    uint after_key = 0u;
    int after_group = -1;
    bool is_own_due = false; // the solid that the ray leaves inwards is to be solved first

    for (;;) {
        iterations++;
        Found found;
        bool is_shadow_ray, is_candidate, is_unshaded;
        for (;;) {
            iterations++;
            bool starts = is_packet_at_rest && begun < PIXELS;
            bool is_reflected = HAS_REFLECTIONS && purpose == REFLECTED;
            if (starts || is_reflected) {
                Real3 direction;
                if (starts) {
                    uvec2 pixel = tile_pixel(begun);
                    direction = primary_direction(pixel, view);
                    purpose = is_there(pixel) ? TO_NEAREST : ENDED;
                    if (begun > 0u) put(begun - 1u, path.color, true);
                    begun++;
                    path = Path(Real3(0.0), 1.0, 0u);
                    origin_surface = OriginSurface(NOTHING, CURVED, false);
                } else if (HAS_REFLECTIONS) {
                    direction = mirrored(ray_direction, nearest.normal);
                    purpose = TO_NEAREST;
                }
                direction = unit(direction);
                ray = Ray(starts ? view.position : nearest.point, starts ? view.position_error : Real3(0.0), direction);
                if (LIGHT_SPHERES > 0u) may_see_light_sphere = starts && may_meet_a_light_sphere(ray, current_light);
                is_hit = false;
                limit = FAR;
                after_key = 0u;
                after_group = -1;
                is_own_due = origin_surface.inside;
            }

            TraversalRay traversal = traversal_ray_of(ray);
            traversal.skipped = origin_surface.slot;
            traversal.after_key = after_key;
            traversal.after_group = after_group;
            is_shadow_ray = HAS_SHADOWS && purpose == TO_LIGHT;
            traversal.target_size = is_shadow_ray ? float(min(largest_component(current_light.position), Real(FAR))) : -1.0;
            found = next_candidate(traversal, limit, purpose != ENDED && !is_own_due);
            bool is_hidden = is_shadow_ray && !is_own_due && found.limit == HIDDEN;
            uint last_key = uint(floatBitsToInt(limit)) | 7u;
            is_candidate = purpose != ENDED && (is_own_due || (found.key <= last_key && !is_hidden));

            // A ray that meets nothing more may end its generation at once.
            bool is_through = purpose != ENDED && !is_candidate;
            bool has_lights_left = LIGHTS > 1u && light_index < frame.light_count;
            bool has_something = is_hit || (LIGHT_SPHERES > 0u && may_see_light_sphere);
            is_unshaded = is_through && (is_shadow_ray ? has_lights_left : has_something);
            if (is_through && is_shadow_ray && !is_hidden) local_radiance = limited(local_radiance + direct);
            if (is_through && !is_shadow_ray && !is_hit) local_radiance = view.background;
            if (is_through && !is_unshaded) purpose = next_bounce(local_radiance, is_hit, hit_material.specular, path);

            const uint WORK = 1u, RAY = 2u;
            uint there_is = (is_candidate || is_unshaded ? WORK : 0u) | (purpose != ENDED ? RAY : 0u);
            there_is = bits_of_packet(there_is);
            is_packet_at_rest = there_is == 0u;
            bool goes_on = there_is == RAY || (is_packet_at_rest && begun < PIXELS);
            // Rays that go each for itself take one iteration of all: left by one after another, this loop is what Mesa
            // 22.3 draws scenes with several lights wrong from.
            if (!IN_PACKETS || !goes_on || iterations >= MAX_ITERATIONS) break;
        }

        // What the ray meets where it meets no solid before.
        Real3 seen = view.background;
        Real seen_t = LARGEST;
        if (LIGHT_SPHERES > 0u) {
            Real3 intensity;
            bool looks = may_see_light_sphere && !is_shadow_ray && (is_candidate || is_unshaded);
            Real light_sphere_t = light_sphere_ahead(ray, current_light, looks, intensity);
            if (looks && light_sphere_t < LARGEST) {
                seen = intensity;
                seen_t = light_sphere_t;
                limit = min(limit, up_to(light_sphere_t));
            }
        }

        Hit hit;
        uint found_slot = 8u * uint(found.group) + (found.key & 7u);
        uint slot = is_own_due ? origin_surface.slot : (is_candidate ? found_slot : 0u);
        bool is_met = meet(slot, ray, origin_surface, hit) && is_candidate;
        Material met = material(slot);
        if (!is_shadow_ray && is_met && (LIGHT_SPHERES == 0u || hit.t <= seen_t) &&
            (!is_hit || is_nearer(hit, met.primitive, nearest, hit_material.primitive, ray))) {
            nearest = hit;
            hit_material = met;
            is_hit = true;
            limit = up_to(hit.t);
        }
        bool is_hidden =
            HAS_SHADOWS && is_shadow_ray && is_met && is_before(hit, ray, current_light.position, light_distance);
        // Whether another candidate may come before what is known.
        uint last_key = uint(floatBitsToInt(limit)) | 7u;
        bool goes_on = is_candidate && !is_hidden && (is_own_due || found.next_key <= last_key);
        after_key = is_own_due ? 0u : found.key;
        after_group = is_own_due ? -1 : found.group;
        is_own_due = is_own_due && !is_candidate;

        // The ray has come to its end: what it brings, and what comes next.
        bool is_done = is_unshaded || (is_candidate && !goes_on);
        if (is_candidate && is_done && is_shadow_ray && !is_hidden) local_radiance = limited(local_radiance + direct);
        if (is_done && !is_shadow_ray) {
            local_radiance = is_hit ? hit_material.ambient * hit_material.color : seen;
            origin_surface = OriginSurface(nearest.slot, nearest.face, nearest.inside);
            ray_direction = ray.direction;
            light_index = 0u;
        }

        // On to the next light that a shadow ray is worth. A packet's rays stay together here, and read no light beyond the
        // last, which would be undefined: as a loop within the branch of those that are done, reading one too many, Mesa
        // 22.3 drew tests/scenes/three_lights.toml wrong. Either change alone cures that; what it came from is not known.
        bool is_lit = false;
        if (LIGHTS > 0u) {
            bool is_seeking = is_done && is_hit && light_index < frame.light_count;
            for (;;) {
                iterations++;
                Light next = current_light;
                if (LIGHTS > 1u) next = light(min(light_index, frame.light_count - 1u));
                Real distance_to_next;
                Real3 direction_to_next = towards(next, nearest.point, distance_to_next);
                Real cosine = dot(nearest.normal, direction_to_next);
                // A light at the hit point gives nothing.
                bool shines = is_seeking && distance_to_next > 0.0 && cosine > 0.0 &&
                              (nearest.face == CURVED || is_above(next, nearest, cosine * distance_to_next));
                Real3 direct_of_next =
                    direct_radiance(hit_material, nearest.normal, ray_direction, direction_to_next, cosine, next);
                // Too little for a shadow ray: half of it is off by half of it, whatever is in the way.
                bool is_faint = path.weight * largest_component(direct_of_next) <= Real(frame.min_shadowed);
                if (HAS_SHADOWS && shines && !is_faint) {
                    is_lit = true;
                    current_light = next;
                    light_distance = distance_to_next;
                    ray = Ray(nearest.point, Real3(0.0), direction_to_next);
                    direct = direct_of_next;
                } else if (shines) {
                    local_radiance = limited(local_radiance + (is_faint ? Real3(0.5) * direct_of_next : direct_of_next));
                }
                light_index += is_seeking ? 1u : 0u;
                is_seeking = is_seeking && !is_lit && light_index < frame.light_count;
                if (LIGHTS == 1u || !any_of_packet(is_seeking)) break;
            }
        }
        if (is_lit) {
            purpose = TO_LIGHT;
            limit = up_to(light_distance);
            after_key = 0u;
            after_group = -1;
            is_own_due = origin_surface.inside;
        } else if (is_done) {
            purpose = next_bounce(local_radiance, is_hit, hit_material.specular, path);
        }
        is_packet_at_rest = !any_of_packet(purpose != ENDED);
        if ((is_packet_at_rest && begun == PIXELS) || iterations >= MAX_ITERATIONS) break;
    }
    // The last pixel, unfinished if iterations ran out; then those never begun: black.
    for (;;) {
        put(begun - 1u, path.color, iterations < MAX_ITERATIONS);
        if (begun == PIXELS) break;
        begun++;
        path.color = Real3(0.0);
    }
}
