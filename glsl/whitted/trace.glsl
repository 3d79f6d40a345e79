// Primary rays through all their generations, step by step.
#include "path.glsl"
#include "branches.glsl"

// A search for what the ray's origin lies in, besides the solid whose surface it leaves: its limit, 0, only lets pass
// what the origin lies in.
void ask_for_medium(inout Path path) {
    path.purpose = TO_MEDIUM;
    path.medium_outside = 1.0;
    path.medium_primitive = NOTHING;
    path.search = SearchState(0.0, 0u, -1, false);
}

// Sets a path's next ray out to the nearest hit: a primary one, through the invocation's pixel of this index, or one on
// from the last hit.
void set_out(bool is_primary, uint pixel_index, View view, inout Path path) {
    if (MEDIA != NO_MEDIA && !is_primary) {
        if (path.purpose == RESUMED) resume(path);
        else if (path.is_hit) branch(path);
        else start_in_medium(path);
    } else {
        Real3 direction;
        if (is_primary) {
            uvec2 pixel = tile_pixel(pixel_index);
            direction = primary_direction(pixel, view);
            path.purpose = is_there(pixel) ? TO_NEAREST : ENDED;
            path.color = Real3(0.0);
            path.weight = 1.0;
            path.generation = 0u;
            path.origin_surface = OriginSurface(NOTHING, CURVED, false);
        } else if (HAS_REFLECTIONS) {
            direction = mirrored(path.incident, path.nearest.normal);
            path.purpose = TO_NEAREST;
        }
        direction = unit(direction);
        Real3 origin = is_primary ? view.position : path.nearest.point;
        path.ray = Ray(origin, is_primary ? view.position_error : Real3(0.0), direction);
    }
    bool is_from_camera = MEDIA == NESTED && path.generation == 0u;
    if (LIGHT_SPHERES > 0u) path.may_see_light_sphere = is_from_camera && path.may_see_light_sphere;
    path.is_hit = false;
    path.search = search_up_to(FAR, path.origin_surface);
    if (MEDIA != NO_MEDIA && is_primary) {
        path.pending = 0u;
        path.medium = 1.0;
        bool asks = MEDIA == NESTED && HAS_REFLECTIONS && view.may_be_in_medium;
        if (asks && path.purpose != ENDED) ask_for_medium(path);
    }
}

// What the search brought up for a path's ray.
struct Candidate {
    bool is_there;
    bool hides_light; // for sure, by its proxy alone: there is nothing to solve
    Found found;
};

Candidate next_candidate(Path path) {
    SearchState state = path.search;
    TraversalRay traversal = traversal_ray_of(path.ray);
    traversal.skipped = path.origin_surface.slot;
    traversal.after_key = state.after_key;
    traversal.after_group = state.after_group;
    Real target_size = min(largest_component(path.light.position), Real(FAR));
    traversal.target_size = is_shadow_ray(path) ? float(target_size) : -1.0;
    Found found = next_candidate(traversal, state.limit, path.purpose != ENDED && !state.is_own_due);
    bool hides_light = is_shadow_ray(path) && !state.is_own_due && found.limit == HIDDEN;
    bool is_before_limit = found.key <= last_key(state.limit) && !hides_light;
    return Candidate(path.purpose != ENDED && (state.is_own_due || is_before_limit), hides_light, found);
}

// A generation is over. Decides what the next ray is cast for.
void end_generation(inout Path path) {
    path.color = limited(path.color + path.weight * path.local_radiance);
    path.generation++;
    if (MEDIA == NO_MEDIA) {
        path.weight *= path.material.reflection;
        bool goes_further = path.is_hit && path.weight > Real(frame.min_throughput) && path.generation < frame.depth;
        path.purpose = HAS_REFLECTIONS && goes_further ? ONWARD : ENDED;
    } else {
        // The most that a ray on from here may weigh: where all is reflected, both together.
        Real weight = path.weight * (path.material.reflection + path.material.transmission);
        bool has_rays = weight > Real(frame.min_throughput);
        bool goes_further = HAS_REFLECTIONS && path.is_hit && has_rays && path.generation < frame.depth;
        path.purpose = goes_further ? ONWARD : (path.pending > 0u ? RESUMED : ENDED);
        if (MEDIA == NESTED && goes_further && path.material.transmission > 0.0 && path.nearest.inside) {
            path.ray = Ray(path.nearest.point, Real3(0.0), path.incident);
            path.origin_surface = OriginSurface(path.nearest.slot, path.nearest.face, false);
            ask_for_medium(path);
        }
    }
}

// A ray that meets nothing more ends its generation at once, if nothing is left to be shaded; else this is true.
bool is_left_to_shade(Candidate candidate, Real3 background, inout Path path) {
    bool is_asking = asks_for_medium(path), is_shadow = is_shadow_ray(path);
    if (is_asking && !candidate.is_there) path.purpose = ONWARD;
    bool is_through = path.purpose != ENDED && !candidate.is_there && !is_asking;
    bool has_lights_left = LIGHTS > 1u && path.light_index < frame.light_count;
    bool has_something = path.is_hit || (LIGHT_SPHERES > 0u && path.may_see_light_sphere);
    bool is_left = is_through && (is_shadow ? has_lights_left : has_something);
    if (is_through && is_shadow && !candidate.hides_light)
        path.local_radiance = limited(path.local_radiance + path.direct);
    if (is_through && !is_shadow && !path.is_hit) path.local_radiance = background;
    if (is_through && !is_left) end_generation(path);
    return is_left;
}

// Solves a candidate exactly and keeps it if it is the nearest so far. True where the ray has come to its end; then its
// radiance is begun, or a shadow ray's light is added.
bool solve(Candidate candidate, bool is_left_to_shade, View view, inout Path path) {
    bool is_shadow = is_shadow_ray(path), is_asking = asks_for_medium(path), is_own_due = path.search.is_own_due;
    // What the ray meets where it meets no solid before.
    Real3 seen = view.background;
    Real seen_t = LARGEST;
    if (LIGHT_SPHERES > 0u) {
        Real3 intensity;
        bool looks = path.may_see_light_sphere && !is_shadow && !is_asking && (candidate.is_there || is_left_to_shade);
        Real light_sphere_t = light_sphere_ahead(path.ray, path.light, looks, intensity);
        if (looks && light_sphere_t < LARGEST) {
            seen = intensity;
            seen_t = light_sphere_t;
            path.search.limit = min(path.search.limit, up_to(light_sphere_t));
        }
    }

    Hit hit;
    uint found_slot = 8u * uint(candidate.found.group) + (candidate.found.key & 7u);
    uint slot = is_own_due ? path.origin_surface.slot : (candidate.is_there ? found_slot : 0u);
    bool is_met = meet(slot, path.ray, path.origin_surface, hit) && candidate.is_there;
    Material material = material(slot);
    if (!is_shadow && !is_asking && is_met && (LIGHT_SPHERES == 0u || hit.t <= seen_t) &&
        (!path.is_hit || is_nearer(hit, material.primitive, path.nearest, path.material.primitive, path.ray))) {
        path.nearest = hit;
        path.material = material;
        path.is_hit = true;
        path.search.limit = up_to(hit.t);
    }
    bool hides_light =
        HAS_SHADOWS && is_shadow && is_met && is_before(hit, path.ray, path.light.position, path.light_distance);
    if (MEDIA != NO_MEDIA && hides_light && material.transmission > 0.0) {
        // What comes through both surfaces, or through the one that is crossed.
        Real3 place = path.light.position;
        bool leaves = !hit.inside && material.refractive_index > 0.0 &&
                      path.light_distance - hit.t_far > SURFACE_ERROR * (largest_component(place) + hit.size);
        path.direct *= leaves ? material.transmission * material.transmission : material.transmission;
        hides_light = false;
    }
    if (is_asking && is_met && hit.inside &&
        (path.medium_primitive == NOTHING ||
         is_nearer(hit, material.primitive, path.medium_exit, path.medium_primitive, path.ray))) {
        path.medium_exit = hit;
        path.medium_primitive = material.primitive;
        path.medium_outside = material.refractive_index;
    }

    // Whether another candidate may come before what is known.
    bool goes_on = candidate.is_there && !hides_light &&
                   (is_own_due || candidate.found.next_key <= last_key(path.search.limit));
    // A path that has just come to ask for a medium has no candidate of that ray yet.
    if (!is_asking || candidate.is_there) {
        path.search.after_key = is_own_due ? 0u : candidate.found.key;
        path.search.after_group = is_own_due ? -1 : candidate.found.group;
        path.search.is_own_due = is_own_due && !candidate.is_there;
    }

    if (is_asking && candidate.is_there && !goes_on) path.purpose = ONWARD;
    bool is_done = !is_asking && (is_left_to_shade || (candidate.is_there && !goes_on));
    if (candidate.is_there && is_done && is_shadow && !hides_light)
        path.local_radiance = limited(path.local_radiance + path.direct);
    if (is_done && !is_shadow) {
        path.local_radiance = path.is_hit ? path.material.ambient * path.material.color : seen;
        if (HAS_AMBIENT_LIGHT && path.is_hit) path.local_radiance = limited(path.local_radiance * view.ambient_light);
        path.origin_surface = OriginSurface(path.nearest.slot, path.nearest.face, path.nearest.inside);
        path.incident = path.ray.direction;
        path.light_index = 0u;
    }
    return is_done;
}

// Of a ray that has come to its end: on to the next light that a shadow ray is worth, if there is one.
//
// A packet's rays stay together here, and read no light beyond the last, which would be undefined: as a loop within the
// branch of those that are done, reading one too many, Mesa 22.3 drew tests/scenes/three_lights.toml wrong. Either
// change alone cures that; what it came from is not known.
bool casts_shadow_ray(bool is_done, inout Path path) {
    bool is_lit = false;
    if (LIGHTS > 0u) {
        bool is_seeking = is_done && path.is_hit && path.light_index < frame.light_count;
        for (;;) {
            iterations++;
            Light next = path.light;
            if (LIGHTS > 1u) next = light(min(path.light_index, frame.light_count - 1u));
            Real light_distance;
            Real3 to_light = towards(next, path.nearest.point, light_distance);
            Real cosine = dot(path.nearest.normal, to_light);
            // A light at the hit point gives nothing.
            bool shines = is_seeking && light_distance > 0.0 && cosine > 0.0 &&
                          (path.nearest.face == CURVED || is_above(next, path.nearest, cosine * light_distance));
            Real3 direct = direct_radiance(path.material, path.nearest.normal, path.incident, to_light, light_distance,
                                           cosine, next);
            // Too little for a shadow ray: half of it is off by half of it, whatever is in the way.
            bool is_faint = path.weight * largest_component(direct) <= Real(frame.min_shadowed);
            if (HAS_SHADOWS && shines && !is_faint) {
                is_lit = true;
                path.light = next;
                path.light_distance = light_distance;
                path.ray = Ray(path.nearest.point, Real3(0.0), to_light);
                path.direct = direct;
            } else if (shines) {
                path.local_radiance = limited(path.local_radiance + (is_faint ? Real3(0.5) * direct : direct));
            }
            path.light_index += is_seeking ? 1u : 0u;
            is_seeking = is_seeking && !is_lit && path.light_index < frame.light_count;
            if (LIGHTS == 1u || !any_of_packet(is_seeking)) break;
        }
    }
    if (is_lit) {
        path.purpose = TO_LIGHT;
        path.search = search_up_to(up_to(path.light_distance), path.origin_surface);
    }
    return is_lit;
}

// Rays of all generations, to the nearest hit and to lights, go the same way, so that neighbours in different stages do
// not wait for each other, and one exact solve stands in the code. The search, which every ray needs, is the inner
// loop; what only a ray with a candidate or a hit needs is gone through when some ray of the packet is there. A packet
// whose rays all came to their end goes on to its next pixels in that loop too: at the end of each pixel the rest would
// be gone through for nobody.
void trace(View view) {
    uint begun = 0u; // of the invocation's pixels
    Path path = path_at_rest(view);
    bool is_packet_at_rest = true;
    hold_boxes();

    for (;;) {
        iterations++;
        Candidate candidate;
        bool is_unshaded;
        for (;;) {
            iterations++;
            bool starts = is_packet_at_rest && begun < PIXELS;
            if (starts || is_to_set_out(path)) {
                if (starts && begun > 0u) put(begun - 1u, path.color, true);
                set_out(starts, begun, view, path);
                begun += starts ? 1u : 0u;
            }
            // All of a packet's rays start at once. Where they do not, a CPU driver goes through the loop once all the same.
            if (LIGHT_SPHERES > 0u && starts)
                path.may_see_light_sphere = may_meet_a_light_sphere(path.ray, path.light);
            if (LIGHT_SPHERES > 1u && !starts) iterations++;
            candidate = next_candidate(path);
            is_unshaded = is_left_to_shade(candidate, view.background, path);

            const uint WORK = 1u, RAY = 2u;
            uint there_is = (candidate.is_there || is_unshaded ? WORK : 0u) | (path.purpose != ENDED ? RAY : 0u);
            there_is = bits_of_packet(there_is);
            is_packet_at_rest = there_is == 0u;
            bool goes_on = there_is == RAY || (is_packet_at_rest && begun < PIXELS);
            // Rays that go each for itself take one iteration of all: left by one after another, this loop is what Mesa
            // 22.3 draws scenes with several lights wrong from.
            if (!IN_PACKETS || !goes_on || iterations >= MAX_ITERATIONS) break;
        }

        bool is_done = solve(candidate, is_unshaded, view, path);
        bool is_lit = casts_shadow_ray(is_done, path);
        if (is_done && !is_lit) end_generation(path);
        is_packet_at_rest = !any_of_packet(path.purpose != ENDED);
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
