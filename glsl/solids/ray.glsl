// Rays, what they leave and what they meet.

struct Ray {
    Real3 origin;
    Real3 origin_error; // of the camera, which is no rounded point; else 0
    Real3 direction;    // of length 1 to a few units in the last place
};

// Faces: the curved one of a sphere, cylinder or cone; of a box 1 + 2 * axis + (positive ? 1 : 0); a cylinder's ends;
// a cone's base.
const uint CURVED = 0u;
const uint SLAB = 1u;
const uint END = 7u;
const uint BASE = 9u;

const uint NOTHING = 0xFFFFFFFFu;

// What is known of a ray's origin.
struct OriginSurface {
    uint slot;    // whose surface it lies on, or NOTHING
    uint face;
    bool inside;  // to which side it leaves
};

struct Hit {
    Real t;
    Real t_far;   // where the ray leaves the solid; of scenes that let light through
    Real3 point;
    Real3 normal; // unit, towards the side the ray came from
    Real size;    // of the solid
    uint slot;
    uint face;
    bool inside;  // the ray came from within
};

// What a ray's origin is to a solid that it may meet.
const uint FREE = 0u;          // a point as stored
const uint OTHER_SURFACE = 1u; // a rounded point of another solid's surface, which this one may touch
const uint OWN_INSIDE = 2u;    // a rounded point of this solid's surface, left inwards

// A point computed to lie on a surface is this near to it, relative to |point| + size of the solid; docs/numerics.md,
// "Leaving a surface".
const Real SURFACE_ERROR = 8.0 * UNIT_ROUNDOFF;

// A ray's line about its point closest to a solid's anchor: position at t = t_closest + t_rest + s (+ t_error) is
// closest + s * direction, seen from the anchor. An error of t_closest only moves `closest` along the line, since
// that is computed for the rounded t.
struct Line {
    Real3 origin; // of the ray, from the anchor; rounded
    Sum3 closest;
    Real3 direction;
    Real direction_squared;
    Real t_closest;
    Real t_rest;
    Real t_error;
};

Line recentred(Ray ray, Real3 anchor, Real3 anchor_error) {
    Sum3 from_anchor = two_sum(ray.origin, -anchor);
    // The errors may be larger than what is left of the difference.
    precise Real3 rest = from_anchor.error + (ray.origin_error - anchor_error);
    Sum3 origin = two_sum(from_anchor.value, rest);
    Line line;
    line.origin = origin.value;
    line.direction = ray.direction;
    line.direction_squared = dot(ray.direction, ray.direction);
#if COMPENSATION
    precise Real t_closest = -dot(origin.value, ray.direction) / line.direction_squared;
    Sum3 closest = add_scaled(origin, t_closest, ray.direction, Real3(0.0));
    // Once more, from there: the first left an error of some u * |origin| along the line.
    precise Real t_rest = -dot(closest.value, ray.direction) / line.direction_squared;
    line.closest = add_scaled(closest, t_rest, ray.direction, Real3(0.0));
    line.t_closest = t_closest;
    line.t_rest = t_rest;
#else
    line.closest = origin;
    line.t_closest = 0.0;
    line.t_rest = 0.0;
#endif
    line.t_error = 0.0;
    return line;
}

// The ray's parameter at a position on its recentred line.
Real t_at(Line line, Real s) {
    return exact_sum(line.t_closest, line.t_rest, s, line.t_error);
}

// How far the closest point is ahead of the ray's origin.
Real line_start(Line line) { return line.t_closest + line.t_rest; }

// Where a line is inside a solid, or inside one of the solids that it is an intersection of; empty where near > far.
struct Interval {
    Real near; // s of a Line
    Real far;
    uint near_face;
    uint far_face;
};

const Interval EMPTY = Interval(1.0, -1.0, CURVED, CURVED);
const Interval WHOLE_LINE = Interval(-LARGEST, LARGEST, CURVED, CURVED);

// The part inside both; at a tie `a` gives the face.
Interval intersection(Interval a, Interval b) {
    bool b_near = b.near > a.near;
    bool b_far = b.far < a.far;
    return Interval(b_near ? b.near : a.near, b_far ? b.far : a.far,
                    b_near ? b.near_face : a.near_face, b_far ? b.far_face : a.far_face);
}

// Between two parallel planes, the line's coordinate across them being offset + s * slope.
Interval between_planes(Real offset, Real slope, Real low, uint low_face, Real high, uint high_face) {
    bool rises = slope > 0.0;
    precise Real near = ((rises ? low : high) - offset) / slope;
    precise Real far = ((rises ? high : low) - offset) / slope;
    Interval crossed = Interval(near, far, rises ? low_face : high_face, rises ? high_face : low_face);
    bool parallel = slope == 0.0;
    bool between = low <= offset && offset <= high;
    return parallel ? (between ? WHOLE_LINE : EMPTY) : crossed;
}

// Roots of a*s^2 + 2*b*s + c, a != 0, given the root of b^2 - a*c. One of them -b may cancel in: then it comes from the
// product of the roots, c/a, unless what c itself lost, being a difference of squares, `c_scale` the larger of them,
// would weigh more.
void ordered_roots(Real a, Real b, Real c, Real c_scale, Real discriminant_root, out Real low, out Real high) {
    bool is_b_positive = b > 0.0;
    precise Real larger = is_b_positive ? -b - discriminant_root : -b + discriminant_root;
    precise Real smaller = is_b_positive ? -b + discriminant_root : -b - discriminant_root;
    precise Real one = larger / a;
    bool is_direct = COMPENSATION == 0 || abs(b * larger) <= abs(a) * c_scale;
    precise Real other = is_direct ? smaller / a : c / larger;
    low = min(one, other);
    high = max(one, other);
}
