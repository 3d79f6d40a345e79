// Directions of light that a matt surface scatters.

// A place in the unit disk, uniform for a place that is uniform in the unit square, whose neighbours stay neighbours
// (Shirley and Chiu 1997). Sine and cosine of an angle up to pi / 4 are Taylor's polynomials, off by 2e-9.
Real2 place_in_disk(Real2 place) {
    Real2 signed_place = 2.0 * place - 1.0;
    bool is_x_larger = abs(signed_place.x) > abs(signed_place.y);
    Real radius = is_x_larger ? signed_place.x : signed_place.y;
    Real ratio = (is_x_larger ? signed_place.y : signed_place.x) / radius;
    Real square = ratio * ratio;
    Real sine = ratio * (0.785398163397 + square * (-0.0807455121883 + square * (0.00249039457019 +
                square * (-0.0000365762041822 + square * 0.000000313361688917))));
    Real cosine = 1.0 + square * (-0.308425137534 + square * (0.0158543442438 + square * (-0.000325991886927 +
                  square * (0.00000359086044859 - square * 0.0000000246113695))));
    return radius * (is_x_larger ? Real2(cosine, sine) : Real2(sine, cosine));
}

// About a unit normal, with a density of cosine / pi: a place in the disk, raised to the hemisphere (Malley). The axes
// across the normal are those of Duff et al. 2017, "Building an orthonormal basis, revisited".
Real3 diffuse_direction(Real3 normal, Real2 place) {
    Real2 across = place_in_disk(place);
    Real height = sqrt(max(1.0 - dot(across, across), Real(0.0)));
    Real side = normal.z >= 0.0 ? 1.0 : -1.0;
    Real a = -1.0 / (side + normal.z), b = normal.x * normal.y * a;
    Real3 first = Real3(1.0 + side * normal.x * normal.x * a, side * b, -side * normal.x);
    Real3 second = Real3(b, side + normal.y * normal.y * a, -normal.y);
    return unit(across.x * first + across.y * second + height * normal);
}
