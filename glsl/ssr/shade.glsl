// The light of a pixel, as it goes along another ray than that to the camera.

// What a light that nothing hides adds at a point of a surface.
Real3 unhidden(Light light, Material material, Hit hit, Real3 incident) {
    Real light_distance;
    Real3 to_light = towards(light, hit.point, light_distance);
    Real cosine = dot(hit.normal, to_light);
    bool shines = light_distance > 0.0 && cosine > 0.0 &&
                  (hit.face == CURVED || is_above(light, hit, cosine * light_distance));
    Real3 direct = direct_radiance(material, hit.normal, incident, to_light, light_distance, cosine, light);
    return shines ? direct : Real3(0.0);
}

// What a hit sends back along a ray, without its reflections. Which lights reach it is taken from a pixel that shows the
// same surface beside it, and so is what transparent solids leave of them all; highlight and angles are the hit's own.
Real3 radiance_along(Real3 incident, Hit hit, Material material, uvec2 pixel, View view) {
    uint place = place_of(pixel);
    Side side = side_of(normals[place].w);
    Hit shown = hit;
    shown.point = points[place].xyz;
    shown.normal = uintBitsToFloat(normals[place].xyz);
    shown.face = side.face;
    Real3 to_shown = unit(primary_direction(pixel, view));

    Real3 ambient = limited(material.ambient * material.color * view.ambient_light);
    Real3 here = Real3(0.0), there = Real3(0.0);
    if (LIGHTS > 0u) {
        uint i = 0u;
        for (;;) {
            iterations++;
            uint index = min(i, frame.light_count - 1u);
            Light next = light(index);
            bool is_lit = !HAS_SHADOWS || (side.lit >> min(index, LIT_BITS - 1u) & 1u) != 0u;
            if (is_lit) here = limited(here + unhidden(next, material, hit, incident));
            if (is_lit && MEDIA != NO_MEDIA) there = limited(there + unhidden(next, material, shown, to_shown));
            i++;
            if (LIGHTS == 1u || !(i < frame.light_count)) break;
        }
    }
    Real share = 1.0;
    if (MEDIA != NO_MEDIA && largest_component(there) > 0.0) {
        // Of the brightest channel, which is known best.
        uint channel = there.x >= max(there.y, there.z) ? 0u : (there.y >= there.z ? 1u : 2u);
        share = clamp((radiances[place][channel] - ambient[channel]) / there[channel], 0.0, 1.0);
    }
    return limited(ambient + share * here);
}
