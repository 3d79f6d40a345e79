// Primary rays through all their generations, step by step. What is kept of a pixel's path decides the kernel: `put`.
#include "branches.glsl"

// Sets a path's next ray out to the nearest hit: a primary one, through the invocation's pixel of this index, or one on
// from the last hit.
void set_out(bool is_primary, uint pixel_index, inout Path path) {
    if (MEDIA != NO_MEDIA && !is_primary) {
        if (path.purpose == RESUMED) resume(path);
        else if (path.is_hit) branch(path);
        else start_in_medium(path);
    } else {
        Real3 direction;
        if (is_primary) {
            uvec2 pixel = tile_pixel(pixel_index);
            direction = primary_direction(pixel, view_at_hand());
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
        path.ray = Ray(path.nearest.point, Real3(0.0), direction);
        if (is_primary) {
            path.ray.origin = view_at_hand().position;
            path.ray.origin_error = view_at_hand().position_error;
        }
    }
    bool is_from_camera = MEDIA == NESTED && path.generation == 0u;
    if (LIGHT_SPHERES > 0u) path.may_see_light_sphere = is_from_camera && path.may_see_light_sphere;
    path.is_hit = false;
    path.search = search_up_to(FAR, path.origin_surface);
    if (MEDIA != NO_MEDIA && is_primary) {
        path.pending = 0u;
        path.medium = 1.0;
        bool asks = MEDIA == NESTED && HAS_REFLECTIONS && view_at_hand().may_be_in_medium;
        if (asks && path.purpose != ENDED) ask_for_medium(path);
    }
}

// A generation is over. Decides what the next ray is cast for.
void end_generation(inout Path path) {
    Material material = nearest_material(path);
    path.color = limited(path.color + path.weight * path.local_radiance);
    path.generation++;
    if (MEDIA == NO_MEDIA) {
        path.weight *= material.reflection;
        bool goes_further = path.is_hit && path.weight > Real(frame.min_throughput) && path.generation < frame.depth;
        path.purpose = HAS_REFLECTIONS && goes_further ? ONWARD : ENDED;
    } else {
        // The most that a ray on from here may weigh: where all is reflected, both together.
        Real weight = path.weight * (material.reflection + material.transmission);
        bool has_rays = weight > Real(frame.min_throughput);
        bool goes_further = HAS_REFLECTIONS && path.is_hit && has_rays && path.generation < frame.depth;
        path.purpose = goes_further ? ONWARD : (path.pending > 0u ? RESUMED : ENDED);
        if (MEDIA == NESTED && goes_further && material.transmission > 0.0 && path.nearest.inside) {
            path.ray = Ray(path.nearest.point, Real3(0.0), path.incident);
            path.origin_surface = OriginSurface(path.nearest.slot, path.nearest.face, false);
            ask_for_medium(path);
        }
    }
}

// A ray goes to each.
Real choice_of_light(Path path) { return 0.0; }

Real3 ambient_radiance(Material material) {
    Real3 radiance = material.ambient * material.color;
    if (HAS_AMBIENT_LIGHT) radiance = limited(radiance * view_at_hand().ambient_light);
    return radiance;
}

// Rays of all generations, to the nearest hit and to lights, go the same way, so that neighbours in different stages do
// not wait for each other, and one exact solve stands in the code. The search, which every ray needs, is the inner
// loop; what only a ray with a candidate or a hit needs is gone through when some ray of the packet is there. A packet
// whose rays all came to their end goes on to its next pixels in that loop too: at the end of each pixel the rest would
// be gone through for nobody.
void trace() {
    hold();
    uint begun = 0u; // of the invocation's pixels
    Path path = path_at_rest();
    bool is_packet_at_rest = true;

    for (;;) {
        iterations++;
        Candidate candidate;
        bool is_unshaded;
        for (;;) {
            iterations++;
            bool starts = is_packet_at_rest && begun < PIXELS;
            if (starts || is_to_set_out(path)) {
                if (starts && begun > 0u) put(begun - 1u, path, true);
                set_out(starts, begun, path);
                begun += starts ? 1u : 0u;
            }
            // All of a packet's rays start at once. Where they do not, a CPU driver goes through the loop once all the same.
            if (LIGHT_SPHERES > 0u && starts)
                path.may_see_light_sphere = may_meet_a_light_sphere(path.ray, path.light);
            if (LIGHT_SPHERES > 1u && !starts) iterations++;
            candidate = next_candidate(path);
            is_unshaded = is_left_to_shade(candidate, path);

            const uint WORK = 1u, RAY = 2u;
            uint there_is = (candidate.is_there || is_unshaded ? WORK : 0u) | (path.purpose != ENDED ? RAY : 0u);
            there_is = bits_of_packet(there_is);
            is_packet_at_rest = there_is == 0u;
            bool goes_on = there_is == RAY || (is_packet_at_rest && begun < PIXELS);
            // Rays that go each for itself take one iteration of all: left by one after another, this loop is what Mesa
            // 22.3 draws scenes with several lights wrong from.
            if (!IN_PACKETS || !goes_on || has_run_out()) break;
        }

        bool is_done = solve(candidate, is_unshaded, path);
        bool is_lit = casts_shadow_ray(is_done, path);
        if (is_done && !is_lit) end_generation(path);
        is_packet_at_rest = !any_of_packet(path.purpose != ENDED);
        if ((is_packet_at_rest && begun == PIXELS) || has_run_out()) break;
    }
    // The last pixel, unfinished if iterations ran out; then those never begun: black.
    for (;;) {
        put(begun - 1u, path, !has_run_out());
        if (begun == PIXELS) break;
        begun++;
        path.color = Real3(0.0);
    }
}
