// Included once for each kind, with SOLID its type and SOLID_LINE what `line_of` makes for it.

// The first point ahead of the ray's origin: where the ray enters, or leaves if it starts inside. An origin within
// rounding of the surface is on it. That is decided by depths: beside an edge the face that the ray leaves by need not
// be the one that its origin is on.
bool meet(SOLID solid, Ray ray, uint origin, uint own_face, out Hit hit) {
    SOLID_LINE at = line_of(solid, ray);
    Interval inside = interval(solid, at);
    bool is_met = inside.near <= inside.far;
    Real place = origin == FREE ? Real(0.0) : largest_component(ray.origin);
    Real position_error = SURFACE_ERROR * (place + size(solid));
    bool starts_inside = IS_CLOSE_UP ? depth_with_errors(solid, at.line.origin, place, Real(1.0)) >= 0.0
                                     : depth(solid, at.line.origin) >= -position_error;
    hit.inside = origin == OWN_INSIDE || starts_inside;
    Real s = hit.inside ? inside.far : inside.near;
    hit.t = t_at(at.line, s);
    hit.t_far = MEDIA != NO_MEDIA ? t_at(at.line, inside.far) : hit.t;
    hit.face = hit.inside ? inside.far_face : inside.near_face;
    bool is_ahead = is_met && hit.t > 0.0;
    if (hit.inside && origin != OWN_INSIDE) {
        // Depth is concave along a chord: at its midpoint it is at least half of the greatest. A free origin is exact:
        // a chord deeper than the error counts, less what the depth itself is off.
        Real least_depth = origin == FREE ? 0.25 * position_error : position_error;
        Real start = max(inside.near, -line_start(at.line));
        Real3 middle = at.line.closest.value + (0.5 * (start + inside.far)) * at.line.direction;
        bool is_deep = IS_CLOSE_UP ? depth_with_errors(solid, middle, place, Real(origin == FREE ? -0.25 : -1.0)) > 0.0
                                   : depth(solid, middle) > least_depth;
        is_ahead = is_ahead && is_deep;
    }
    // A ray inside of a convex solid does leave it: where rounding put its origin beyond the exit, where it starts.
    bool leaves_here = origin == OWN_INSIDE && !is_ahead;
    if (leaves_here) {
        hit.t = 0.0;
        s = -line_start(at.line);
        if (!is_met) hit.face = own_face;
    }
    surface(solid, at, s, hit.face, hit.point, hit.normal);
    if (leaves_here) hit.point = ray.origin;
    if (hit.inside) hit.normal = -hit.normal;
    hit.size = IS_CLOSE_UP ? size_near(solid, hit.point) : size(solid);
    return is_ahead || leaves_here;
}
