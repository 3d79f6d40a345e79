use glam::DVec3;

/// Coefficients of equation 1.18 of the course work; each in [0, 1].
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Linear RGB.
    pub color: DVec3,
    /// k_a
    pub ambient: f64,
    /// k_d
    pub diffuse: f64,
    /// k_s: weight of the highlight and of the reflected ray.
    pub specular: f64,
}

impl Default for Material {
    fn default() -> Self {
        Self { color: DVec3::new(0.3, 0.5, 0.7), ambient: 0.1, diffuse: 0.1, specular: 0.1 }
    }
}
