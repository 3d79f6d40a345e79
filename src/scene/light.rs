use glam::DVec3;

/// A point light, which primary rays see from outside as a sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// World frame; the centre of the sphere.
    pub position: DVec3,
    /// Linear RGB, not limited to 1.
    pub intensity: DVec3,
    /// Radius of that sphere, world units; 0: it is not seen. A camera inside does not see it either.
    pub radius: f64,
    /// K of equation 1.16, world units: a point at distance d gets the intensity divided by d + K. `None`: it gets all
    /// of it from any distance.
    pub distance_constant: Option<f64>,
}

impl Light {
    /// What is left of the light at a distance d, counted in lengths, `scale` of them a world unit: x / (y·d + z).
    ///
    /// 1 / (d / scale + K), with a = 1 / scale and g, the larger of a and K: (1/g) / (d·(a/g) + K/g) keeps all three in
    /// the range of `f32`.
    pub(crate) fn fading(&self, scale: f64) -> DVec3 {
        let Some(constant) = self.distance_constant else { return DVec3::new(1.0, 0.0, 1.0) };
        let unit = scale.recip();
        let largest = unit.max(constant);
        DVec3::new(largest.recip(), unit / largest, constant / largest)
    }

    /// Radius of the course's light sphere (`R_LSOURCE`), world units.
    pub const COURSE_RADIUS: f64 = 0.01;
}

impl Default for Light {
    fn default() -> Self {
        Self { position: DVec3::ZERO, intensity: DVec3::ONE, radius: Self::COURSE_RADIUS, distance_constant: None }
    }
}
