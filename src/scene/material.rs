use glam::DVec3;

/// Coefficients of equation 1.19 of the course work; those that weigh light are each in [0, 1].
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Linear RGB.
    pub color: DVec3,
    /// k_a
    pub ambient: f64,
    /// k_d
    pub diffuse: f64,
    /// k_s: weight of the highlight.
    pub specular: f64,
    /// Weight of the mirrored ray; `None`: that of the highlight, as in the course work.
    pub reflection: Option<f64>,
    /// n: exponent of the highlight, 1 to 1024; see [`Material::shininess_256`].
    pub shininess: f64,
    /// k_t: weight of the refracted ray, and what a surface lets through of a light behind it.
    pub transmission: f64,
    /// η of the inside, against 1 of empty space.
    pub refractive_index: f64,
}

impl Material {
    /// Exponent of the course work.
    pub const COURSE_SHININESS: f64 = 5.0;

    /// By the course work's coefficients alone, which is without refraction.
    pub const fn of_course(color: DVec3, ambient: f64, diffuse: f64, specular: f64) -> Self {
        let (shininess, refractive_index) = (Self::COURSE_SHININESS, 1.0);
        Self { color, ambient, diffuse, specular, reflection: None, shininess, transmission: 0.0, refractive_index }
    }

    /// Weight of the mirrored ray.
    pub fn reflection(&self) -> f64 {
        self.reflection.unwrap_or(self.specular)
    }

    /// The exponent as renderers take it: a whole number of 256ths, so that squares and square roots raise to it.
    pub fn shininess_256(&self) -> u32 {
        (self.shininess * 256.0).round() as u32
    }
}

impl Default for Material {
    fn default() -> Self {
        Self::of_course(DVec3::new(0.3, 0.5, 0.7), 0.1, 0.1, 0.1)
    }
}
