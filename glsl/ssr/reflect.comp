#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Screen-space reflections, last pass: mirrored rays find what the camera sees, generation by generation. A solid seen in
// a pixel that a ray passes behind is solved exactly: the ray meets it, or passes behind it.
layout(local_size_x_id = 5, local_size_y_id = 6) in;

#include "records/records.glsl"
#include "solids/solids.glsl"
#include "camera/camera.glsl"
#include "transport/shade.glsl"
#define ACCESS readonly
#define RADIANCES 11
#include "ssr/surfaces.glsl"
#include "ssr/march.glsl"
#include "ssr/shade.glsl"

layout(binding = 0, std430) writeonly buffer Picture { vec4 picture[]; }; // as of `camera/picture.glsl`

// The picture is why reflections may be wrong, in colours.
layout(constant_id = 27) const bool SHOWS_REASONS = false;

// What came of a pixel's mirrored rays; of those that went wrong the first counts. docs/screen-space.md has the legend.
const uint NO_MIRROR = 0u;
const uint FOUND = 1u;         // all that they meet is seen, or they meet nothing
const uint LEFT_SCREEN = 2u;   // one left the picture, and what it would have met is not known
const uint HIDDEN = 3u;        // one meets a surface that something hides from the camera
const uint BACK = 4u;          // one meets a side of a solid that the camera does not see
const uint PASSED_BEHIND = 5u; // one passed behind something, and what is there is not known
const vec3 COLORS[6] = vec3[](vec3(0.0), vec3(0.0, 0.5, 0.0), vec3(0.0, 0.3, 1.0), vec3(1.0, 0.0, 0.0),
                              vec3(1.0, 1.0, 0.0), vec3(1.0, 0.0, 1.0));

// What a march found.
struct Found {
    bool is_met;
    Hit hit;
    uvec2 pixel; // where its solid was seen
};

// Solves the solid that a march has come to, and keeps the nearest.
void solve(Ray ray, OriginSurface origin_surface, inout March march, inout Found found) {
    bool is_there = march.candidate != NOTHING;
    Hit hit;
    bool is_met = meet(is_there ? march.candidate : 0u, ray, origin_surface, hit) && is_there;
    float x = screen_parameter(march, hit.t);
    if (is_met && x < march.end) {
        found = Found(true, hit, march.pixel);
        end_at(x, march);
    }
    march.candidate = NOTHING;
}

bool is_side_shown(Hit hit, uvec2 pixel) {
    uint place = place_of(pixel);
    return depths[place].y == hit.slot && side_of(normals[place].w).is_inner == hit.inside;
}

// Whether the picture shows what was met, and the pixel that does: its own or, at an edge, that beside it where the
// solid was seen.
uint reason_for(Found found, March march, View view, out uvec2 pixel) {
    pixel = found.pixel;
    // A cell of the pyramid may reach beyond the picture.
    vec2 end = floor(place_at(march, march.end)), size = vec2(unpacked(frame.image_size));
    bool is_within = march.end < LARGEST && all(greaterThanEqual(end, vec2(0.0))) && all(lessThan(end, size));
    if (!found.is_met) {
        if (march.has_passed) return PASSED_BEHIND;
        return march.ending == OFF_SCREEN || !is_within ? LEFT_SCREEN : FOUND;
    }
    if (dot(found.hit.normal, found.hit.point - view.position) >= 0.0) return BACK;
    if (!is_within) return LEFT_SCREEN;
    ivec2 own = ivec2(end);
    if (is_side_shown(found.hit, uvec2(own))) {
        pixel = uvec2(own);
        return FOUND;
    }
    bool is_beside = all(lessThanEqual(abs(own - ivec2(pixel)), ivec2(1)));
    return is_beside && is_side_shown(found.hit, pixel) ? FOUND : HIDDEN;
}

// The pixel's colour with what its mirrored rays find.
Real3 with_reflections(uvec2 own_pixel, View view, out uint reason) {
    uint place = place_of(own_pixel);
    Real3 color = radiances[place].rgb;
    Real weight = radiances[place].a;
    Side side = side_of(normals[place].w);
    Real3 point = points[place].xyz, normal = uintBitsToFloat(normals[place].xyz);
    OriginSurface origin_surface = OriginSurface(depths[place].y, side.face, side.is_inner);
    Real3 incident = unit(primary_direction(own_pixel, view));
    uint generation = 1u;
    bool goes_on = weight > 0.0 && generation < frame.depth;
    reason = goes_on ? FOUND : NO_MIRROR;
    for (;;) {
        iterations++;
        Ray ray = Ray(point, Real3(0.0), unit(mirrored(incident, normal)));
        March march = march_along(ray, origin_surface, view, goes_on);
        Found found;
        found.is_met = false;
        found.pixel = uvec2(0u);
        for (;;) {
            iterations++;
            for (;;) {
                iterations++;
                if (march.ending == UNDER_WAY) step_on(march);
                if (march.candidate != NOTHING || march.ending != UNDER_WAY || has_run_out()) break;
            }
            solve(ray, origin_surface, march, found);
            if (march.ending != UNDER_WAY || has_run_out()) break;
        }

        uvec2 pixel;
        uint outcome = reason_for(found, march, view, pixel);
        bool is_lit = goes_on && found.is_met && outcome == FOUND;
        if (is_lit) {
            Material material = material(found.hit.slot);
            color = limited(color + weight * radiance_along(ray.direction, found.hit, material, pixel, view));
            weight *= material.reflection;
            point = found.hit.point;
            normal = found.hit.normal;
            incident = ray.direction;
            origin_surface = OriginSurface(found.hit.slot, found.hit.face, found.hit.inside);
            generation++;
        } else if (goes_on) {
            color = limited(color + weight * view.background);
            reason = outcome;
        }
        goes_on = is_lit && weight > 0.0 && generation < frame.depth;
        if (!goes_on || has_run_out()) break;
    }
    return color;
}

void main() {
    uvec2 pixel = tile_pixel(0u);
    if (!is_there(pixel)) return;
    vec4 seen = radiances[place_of(pixel)];
    Real3 color = seen.rgb;
    uint reason = NO_MIRROR;
    if (HAS_REFLECTIONS) color = with_reflections(pixel, view(), reason);
    bool is_ended = seen.a != UNFINISHED && !has_run_out();
    picture[place_of(pixel)] = vec4(SHOWS_REASONS ? COLORS[reason] : color, is_ended ? 1.0 : 0.0);
}
