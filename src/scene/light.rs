use glam::DVec3;

/// A point light without attenuation; primary rays see it as a ball of radius [`Light::BALL_RADIUS`].
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    pub position: DVec3,
    /// Linear RGB, not limited to 1.
    pub intensity: DVec3,
}

impl Light {
    /// Radius of the visible ball (`R_LSOURCE` of the course work), world units.
    pub const BALL_RADIUS: f64 = 0.01;
}

impl Default for Light {
    fn default() -> Self {
        Self { position: DVec3::ZERO, intensity: DVec3::ONE }
    }
}
