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

// What a hit sends back along a ray, without its reflections. What shadows leave of its lights is taken from a pixel that
// shows the same surface beside it, a share for each channel: the highlight and the angle to the lights are the hit's own.
Real3 radiance_along(Real3 incident, Hit hit, Material material, uvec2 pixel, View view) {
    uint place = place_of(pixel);
    Hit shown = hit;
    shown.point = uintBitsToFloat(points[place].xyz);
    shown.normal = uintBitsToFloat(normals[place].xyz);
    shown.face = bitfieldExtract(normals[place].w, 0, int(INNER_SIDE_BIT));
    Real3 to_shown = unit(primary_direction(pixel, view));

    Real3 ambient = limited(material.ambient * material.color * view.ambient_light);
    Real3 here = Real3(0.0), there = Real3(0.0);
    if (LIGHTS > 0u) {
        uint i = 0u;
        for (;;) {
            iterations++;
            Light next = light(min(i, frame.light_count - 1u));
            here = limited(here + unhidden(next, material, hit, incident));
            if (HAS_SHADOWS) there = limited(there + unhidden(next, material, shown, to_shown));
            i++;
            if (LIGHTS == 1u || !(i < frame.light_count)) break;
        }
    }
    Real3 share = Real3(1.0);
    if (HAS_SHADOWS) {
        Real3 direct = radiances[place].rgb - ambient;
        share = mix(Real3(0.0), clamp(direct / there, 0.0, 1.0), greaterThan(there, Real3(0.0)));
    }
    return limited(ambient + share * here);
}
