use glam::DVec3;

/// A half-line in the world frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Finite, or the ray meets nothing.
    pub origin: DVec3,
    /// Vector of any length whose square is a positive finite `f64`; distances along the ray count in this length.
    pub direction: DVec3,
}

/// On which side of a solid's surface a ray arrives or leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// The unbounded side.
    Outside,
    /// The side that the solid fills.
    Inside,
}

/// Part of a solid's surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Face {
    /// The sphere, the cylinder's body, the cone's side.
    Curved,
    /// Face of a box: where the coordinate of this box axis (0, 1, 2) is +half size or −half size.
    Slab {
        /// Axis of the box's own frame.
        axis: u8,
        /// Whether it is +half size.
        positive: bool,
    },
    /// Base of a cylinder about `ends[0]` or `ends[1]`.
    End(u8),
    /// The cone's base disk.
    Base,
}

/// Where a ray first meets a solid, in the world frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// In lengths of the ray's direction.
    pub t: f64,
    /// On the surface to rounding.
    pub point: DVec3,
    /// Unit normal towards the side the ray came from.
    pub normal: DVec3,
    /// Index into `Scene::primitives`.
    pub primitive: u32,
    /// What it meets of the primitive's surface.
    pub face: Face,
    /// The one the ray came from.
    pub side: Side,
}

impl Side {
    /// The one beyond the surface.
    pub fn other(self) -> Self {
        match self {
            Self::Outside => Self::Inside,
            Self::Inside => Self::Outside,
        }
    }
}

impl Hit {
    /// How a ray leaves this hit to a side.
    pub fn left_by(&self, side: Side) -> OriginSurface {
        OriginSurface::Surface { primitive: self.primitive, face: self.face, side }
    }

    /// How a reflected or a shadow ray leaves this hit.
    pub fn origin_surface(&self) -> OriginSurface {
        self.left_by(self.side)
    }
}

/// What is known of a ray's origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OriginSurface {
    /// A point in space, taken as stored.
    Free,
    /// A point computed to lie on a primitive, from which the ray leaves to this side: a convex solid cannot be met
    /// again from outside, and only its exit can be met from inside.
    Surface {
        /// Index into `Scene::primitives`.
        primitive: u32,
        /// Face of that primitive, where the point lies on it.
        face: Face,
        /// Into which the ray leaves.
        side: Side,
    },
}
