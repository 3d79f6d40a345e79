// What a pixel's path is made of: its ray, the surface that this met, and the light that a shadow ray goes to.

// What a path's ray is cast for.
const uint ENDED = 0u;     // nothing more
const uint TO_NEAREST = 1u;
const uint TO_LIGHT = 2u;
const uint ONWARD = 3u;    // to the nearest; the ray is still to be made of the last hit
const uint RESUMED = 4u;   // to the nearest; the ray is still to be taken from those pending
const uint TO_MEDIUM = 5u; // to find out what a point lies in

// How far the search for what a ray meets has come.
struct SearchState {
    float limit;     // nothing beyond it is of interest
    uint after_key;  // candidates up to this one have been tested
    int after_group;
    bool is_own_due; // the solid that the ray leaves inwards is to be solved first
};

struct Path {
    Real3 color;     // linear RGB, of the generations that are over
    Weight weight;   // in it, of the present one
    uint generation;
    uint pending;    // rays that it goes on by later

    uint purpose;
    Ray ray;
    Real medium;     // refractive index of what it goes through
    OriginSurface origin_surface;
    bool may_see_light_sphere; // a primary ray that may
    SearchState search;

    // The nearest hit so far of a ray to the nearest, and then what its lights add up to.
    bool is_hit;
    Hit nearest;
    Material material;
    Real3 incident;       // the direction of the ray that met it
    Real3 local_radiance;
    uint light_index;     // of the first light that has not been tested
    uint lit;             // bit of each light that reaches the hit; those from LIT_BITS - 1 on share the last
    // The innermost other solid about the ray's origin, which is the one that the ray straight on leaves first: its
    // refractive index, where the ray leaves it, and its index in the scene.
    Real medium_outside;
    Hit medium_exit;
    uint medium_primitive; // or NOTHING

    // What a shadow ray goes to.
    Light light;
    Real light_distance;
    Real3 direct;         // radiance back along the ray that met the surface, if nothing hides the light
};

// Before the first pixel.
Path path_at_rest() {
    View view = view_at_hand();
    Path path;
    path.color = Real3(0.0);
    path.weight = Weight(1.0);
    path.generation = 0u;
    path.pending = 0u;
    path.purpose = ENDED;
    path.medium = 1.0;
    path.medium_outside = 1.0;
    path.medium_primitive = NOTHING;
    path.ray = Ray(view.position, view.position_error, view.ahead);
    path.origin_surface = OriginSurface(NOTHING, CURVED, false);
    path.may_see_light_sphere = false;
    path.search = SearchState(FAR, 0u, -1, false);
    path.is_hit = false;
    path.nearest.slot = 0u;
    path.incident = path.ray.direction;
    path.local_radiance = Real3(0.0);
    path.light_index = 0u;
    path.lit = 0u;
    // A packet reads the only one once.
    if (IN_PACKETS && (LIGHTS == 1u || LIGHT_SPHERES == 1u)) path.light = light(0u);
    return path;
}

// Of the nearest hit, or of any solid where there is none.
Material nearest_material(Path path) {
    Material nearest = path.material;
    if (!IN_PACKETS) nearest = material(path.nearest.slot);
    return nearest;
}

// Whether the path's next ray is still to be made.
bool is_to_set_out(Path path) {
    if (MEDIA != NO_MEDIA && path.purpose == RESUMED) return true;
    return HAS_REFLECTIONS && path.purpose == ONWARD;
}

bool asks_for_medium(Path path) { return MEDIA == NESTED && path.purpose == TO_MEDIUM; }

bool is_shadow_ray(Path path) { return HAS_SHADOWS && path.purpose == TO_LIGHT; }

// The key that a candidate must not be above, if it may come before the limit.
uint last_key(float limit) { return uint(floatBitsToInt(limit)) | 7u; }

// A bound for what lies at or before t, from the exact t.
float up_to(Real t) { return float(min(t, Real(FAR))) * (1.0 + 4.0 * FLOAT_ROUNDOFF); }

SearchState search_up_to(float limit, OriginSurface origin_surface) {
    return SearchState(limit, 0u, -1, origin_surface.inside);
}
