// A pixel's samples, a path each (docs/path-tracing.md).
#include "numbers.glsl"
#include "diffuse.glsl"
#include "successors.glsl"

// Sets a path's next ray out to the nearest hit: a primary one through the pixel, or one on from the last hit.
void set_out(bool is_primary, uvec2 pixel, inout Path path) {
    if (is_primary) {
        View view = view_at_hand();
        path.ray = Ray(view.position, view.position_error, unit(direction_within(pixel, pair(PLACE_IN_PIXEL), view)));
        path.purpose = TO_NEAREST;
        path.color = Real3(0.0);
        path.weight = Weight(1.0);
        path.generation = 0u;
        path.origin_surface = OriginSurface(NOTHING, CURVED, false);
        path.medium = 1.0;
    } else if (MEDIA != NESTED || path.is_hit) {
        go_on(path);
    } else {
        start_in_medium(path);
    }
    // Of these, the exact test finds which do.
    bool is_from_camera = MEDIA == NESTED && path.generation == 0u;
    path.may_see_light_sphere = LIGHT_SPHERES > 0u && (is_primary || is_from_camera);
    path.is_hit = false;
    path.search = search_up_to(FAR, path.origin_surface);
    bool asks = MEDIA == NESTED && HAS_REFLECTIONS && view_at_hand().may_be_in_medium;
    if (is_primary && asks) ask_for_medium(path);
}

// As `trace` of whitted/trace.glsl, but that a ray of a packet whose path has ended begins the next sample at once:
// lengths of paths differ too much to wait for each other.
void trace_samples() {
    hold();
    uvec2 pixel = tile_pixel(0u);
    uvec2 in_picture = unpacked(frame.tile_origin) + pixel;
    sequence.seed = hashed(frame.seed ^ hashed(in_picture.x | in_picture.y << 16));
    uint samples = is_there(pixel) ? frame.samples_at_once : 0u;
    uint begun = 0u;
    Real3 sum = Real3(0.0);
    Path path = path_at_rest();

    for (;;) {
        iterations++;
        Candidate candidate;
        bool is_unshaded;
        for (;;) {
            iterations++;
            bool starts = path.purpose == ENDED && begun < samples;
            if (starts || path.purpose == ONWARD) {
                if (starts) {
                    sum += path.color;
                    sequence.index = frame.samples_before + begun;
                    begun++;
                }
                set_out(starts, pixel, path);
            }
            candidate = next_candidate(path);
            is_unshaded = is_left_to_shade(candidate, path);

            const uint WORK = 1u, RAY = 2u;
            bool is_under_way = path.purpose != ENDED || begun < samples;
            uint there_is = bits_of_packet((candidate.is_there || is_unshaded ? WORK : 0u) | (is_under_way ? RAY : 0u));
            // Rays that go each for itself take one iteration of all, as in `trace`.
            if (!IN_PACKETS || there_is != RAY || has_run_out()) break;
        }

        bool is_done = solve(candidate, is_unshaded, path);
        bool is_lit = casts_shadow_ray(is_done, path);
        if (is_done && !is_lit) end_generation(path);
        bool is_under_way = path.purpose != ENDED || begun < samples;
        if (!any_of_packet(is_under_way) || has_run_out()) break;
    }
    // The last sample is unfinished if iterations ran out.
    uint ended = path.purpose == ENDED ? begun : begun - 1u;
    if (path.purpose == ENDED) sum += path.color;
    put(0u, sum / Real(max(ended, 1u)), float(ended));
}
