use glam::DVec3;

/// A point light without attenuation, which primary rays see from outside as a sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// World frame; the middle of the sphere.
    pub position: DVec3,
    /// Linear RGB, not limited to 1.
    pub intensity: DVec3,
    /// Of that sphere, world units; 0: it is not seen. A camera inside does not see it either.
    pub radius: f64,
}

impl Light {
    /// Of the course's (`R_LSOURCE`), world units.
    pub const COURSE_RADIUS: f64 = 0.01;
}

impl Default for Light {
    fn default() -> Self {
        Self { position: DVec3::ZERO, intensity: DVec3::ONE, radius: Self::COURSE_RADIUS }
    }
}
