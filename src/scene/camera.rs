use glam::DVec3;

/// Which part of the image plane the picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Projection {
    /// The window [-1,1]×[-1,1] in units of the half extent: the optical axis meets the picture's centre.
    #[default]
    Centered,
    /// The course's off-axis window [-3,1]×[-3,1]: a lens shift that puts the optical axis at 75 % of the width and
    /// 25 % of the height from the top.
    Course,
}

impl Projection {
    /// The default first.
    pub const ALL: [Projection; 2] = [Self::Centered, Self::Course];

    /// The word of the scene file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Centered => "centered",
            Self::Course => "course",
        }
    }
}

/// A pinhole camera in the world frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// The pinhole's, world frame.
    pub position: DVec3,
    /// Viewing direction; any length but zero.
    pub direction: DVec3,
    /// Any vector not parallel to `direction`.
    pub up: DVec3,
    /// Angle between the centred window's lower and upper edge, in (0, 180).
    pub vertical_fov_degrees: f64,
    /// Where the optical axis meets the picture.
    pub projection: Projection,
}

impl Camera {
    /// The course's field of view: 0.5 rad.
    pub const COURSE_FOV_DEGREES: f64 = 0.5 * 180.0 / std::f64::consts::PI;
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            position: DVec3::new(0.0, 0.0, -2.0),
            direction: DVec3::Z,
            up: DVec3::Y,
            vertical_fov_degrees: Self::COURSE_FOV_DEGREES,
            projection: Projection::default(),
        }
    }
}
