// The two pieces that the listings call or need without showing them.

// The mirror ray, started 0.02 off the surface.
Ray calculateReflected(Ray ray, Intersection hit) {
    return Ray(hit.point + 0.02 * hit.normal, normalize(reflect(ray.direction, hit.normal)));
}

// The ray through a point of the picture in [-1,1]², x to the right, y up. Normalized twice, as the course did.
// The course fed [-1,1]² to a formula meant for [0,1]², which shifts the window: see Projection::Course.
Ray primaryRay(vec2 point, float aspect) {
    vec2 p = frame.window_low < 0.0 ? point : 0.5 * point + 0.5;
    float a = (1.0 - 2.0 * p.x) * aspect * frame.half_fov_tangent;
    float b = (2.0 * p.y - 1.0) * frame.half_fov_tangent;
    vec3 local = normalize(vec3(a, b, -1.0));
    precise vec3 world = local.x * frame.camera_s + local.y * frame.camera_u + local.z * frame.camera_f;
    return Ray(frame.camera_position, normalize(world));
}
