// The steps of a path's rays, to the nearest hit and to lights, which every algorithm that traces paths takes: search,
// exact solve, shading. It decides itself what a path goes on by:

// A generation is over. Decides what the next ray is cast for.
void end_generation(inout Path path);
// What a surface sends back of light that comes from everywhere, before its lights.
Real3 ambient_radiance(Material material);
// Between 0 and 1, by chance: which of many lights the hit's shadow ray goes to.
Real choice_of_light(Path path);

// A search for what the ray's origin lies in, besides the solid whose surface it leaves: its limit, 0, only lets pass
// what the origin lies in.
void ask_for_medium(inout Path path) {
    path.purpose = TO_MEDIUM;
    path.medium_outside = 1.0;
    path.medium_primitive = NOTHING;
    path.search = SearchState(0.0, 0u, -1, false);
}

// From the camera, once it is known what that is in.
void start_in_medium(inout Path path) {
    path.medium = path.medium_outside;
    path.purpose = TO_NEAREST;
}

// The light with this index reaches the nearest hit.
void add_light(uint index, Real3 direct, inout Path path) {
    path.local_radiance = limited(path.local_radiance + direct);
    path.lit |= 1u << min(index, LIT_BITS - 1u);
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

// A ray that meets nothing more ends its generation at once, if nothing is left to be shaded; else this is true.
bool is_left_to_shade(Candidate candidate, inout Path path) {
    bool is_asking = asks_for_medium(path), is_shadow = is_shadow_ray(path);
    if (is_asking && !candidate.is_there) path.purpose = ONWARD;
    bool is_through = path.purpose != ENDED && !candidate.is_there && !is_asking;
    bool has_lights_left = LIGHTS > 1u && path.light_index < frame.light_count;
    bool has_something = path.is_hit || (LIGHT_SPHERES > 0u && path.may_see_light_sphere);
    bool is_left = is_through && (is_shadow ? has_lights_left : has_something);
    if (is_through && is_shadow && !candidate.hides_light) add_light(path.light_index - 1u, path.direct, path);
    if (is_through && !is_shadow && !path.is_hit) path.local_radiance = view_at_hand().background;
    if (is_through && !is_left) end_generation(path);
    return is_left;
}

// Solves a candidate exactly and keeps it if it is the nearest so far. True where the ray has come to its end; then its
// radiance is begun, or a shadow ray's light is added.
bool solve(Candidate candidate, bool is_left_to_shade, inout Path path) {
    bool is_shadow = is_shadow_ray(path), is_asking = asks_for_medium(path), is_own_due = path.search.is_own_due;
    // What the ray meets where it meets no solid before.
    Real3 seen = view_at_hand().background;
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
        (!path.is_hit || is_nearer(hit, material.primitive, path.nearest, nearest_material(path).primitive, path.ray))) {
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
        add_light(path.light_index - 1u, path.direct, path);
    if (is_done && !is_shadow) {
        path.local_radiance = seen;
        if (path.is_hit) path.local_radiance = ambient_radiance(nearest_material(path));
        path.origin_surface = OriginSurface(path.nearest.slot, path.nearest.face, path.nearest.inside);
        path.incident = path.ray.direction;
        path.light_index = 0u;
        path.lit = 0u;
    }
    return is_done;
}

// The brightest channel of what a weight makes of a radiance.
Real brightest(Real weight, Real3 radiance) { return weight * largest_component(radiance); }
Real brightest(Real3 weight, Real3 radiance) { return largest_component(weight * radiance); }

// Whether it is kept of a hit which lights reach it: then those are tried, too, that give this pixel nothing.
#ifndef KEEPS_LIT
#define KEEPS_LIT false
#endif

// The least brightness that is chosen by.
const Real LEAST_CHOSEN = 1e-30;

// Of a ray that has come to its end: on to the next light that a shadow ray is worth, if there is one.
//
// A packet's rays stay together here, and read no light beyond the last, which would be undefined: as a loop within the
// branch of those that are done, reading one too many, Mesa 22.3 drew tests/scenes/three_lights.toml wrong. Either
// change alone cures that; what it came from is not known.
//
// Of many lights, one is chosen in proportion to the brightest channel of what it adds to the pixel where nothing hides
// it, in a single pass: each in turn takes the place of the one before with its share of the sum so far, and the number
// that decided is spread over 0 to 1 again. Its light then stands for all.
bool casts_shadow_ray(bool is_done, inout Path path) {
    Real choice = 0.0, sum = 0.0;
    bool is_lit = false;
    if (LIGHTS > 0u) {
        if (CHOOSES_LIGHT) choice = choice_of_light(path);
        bool is_seeking = is_done && path.is_hit && path.light_index < frame.light_count;
        for (;;) {
            iterations++;
            Light next = path.light;
            if (LIGHTS > 1u || !IN_PACKETS) next = light(min(path.light_index, frame.light_count - 1u));
            Real light_distance;
            Real3 to_light = towards(next, path.nearest.point, light_distance);
            Real cosine = dot(path.nearest.normal, to_light);
            // A light at the hit point gives nothing.
            bool shines = is_seeking && light_distance > 0.0 && cosine > 0.0 &&
                          (path.nearest.face == CURVED || is_above(next, path.nearest, cosine * light_distance));
            Real3 direct = direct_radiance(nearest_material(path), path.nearest.normal, path.incident, to_light,
                                           light_distance, cosine, next);
            // Too little for a shadow ray: half of it is off by half of it, whatever is in the way.
            bool is_faint = !KEEPS_LIT && brightest(path.weight, direct) <= Real(frame.min_shadowed);
            bool is_chosen = true;
            if (CHOOSES_LIGHT) {
                direct = limited(direct);
                Real before = sum, gives = brightest(path.weight, direct);
                // What is next to nothing is none: quotients of the least numbers are none.
                if (!shines || gives < LEAST_CHOSEN) gives = 0.0;
                sum = min(before + gives, LARGEST);
                Real place = choice * sum;
                is_chosen = gives > 0.0 && (place < gives || before == 0.0);
                if (gives > 0.0) choice = is_chosen ? place / gives : (place - gives) / before;
            }
            if (HAS_SHADOWS && shines && (CHOOSES_LIGHT || !is_faint) && is_chosen) {
                is_lit = true;
                path.light = next;
                path.light_distance = light_distance;
                path.ray = Ray(path.nearest.point, Real3(0.0), to_light);
                path.direct = direct;
            } else if (shines && !CHOOSES_LIGHT) {
                add_light(path.light_index, is_faint ? Real3(0.5) * direct : direct, path);
            }
            path.light_index += is_seeking ? 1u : 0u;
            is_seeking = is_seeking && (CHOOSES_LIGHT || !is_lit) && path.light_index < frame.light_count;
            if (LIGHTS == 1u || !any_of_packet(is_seeking)) break;
        }
    }
    if (is_lit) {
        // Divided first, so that no factor overflows.
        if (CHOOSES_LIGHT) path.direct = limited((path.direct / brightest(path.weight, path.direct)) * sum);
        path.purpose = TO_LIGHT;
        path.search = search_up_to(up_to(path.light_distance), path.origin_surface);
    }
    return is_lit;
}
