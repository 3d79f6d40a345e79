//! How solids are found.

use super::{Decision, Reason};
use crate::settings::RenderSettings;

/// How the nearest solid is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Structure {
    /// Every solid's proxy is tested by every ray.
    None,
    /// Boxes around every eight solids, around every eight boxes, and so on: so many levels.
    Hierarchy {
        /// From 1 to [`Structure::MOST_LEVELS`].
        levels: u32,
    },
}

impl Structure {
    /// Up to so many solids of a kind a ray looks at each of them, or at so many boxes of the topmost of several
    /// levels.
    pub const BREAK_EVEN: usize = 32;

    /// One level alone has at most so many boxes: two groups, which every search enters.
    pub const MOST_ALONE: usize = 2 * Self::GROUP;

    /// Solids in a box, and boxes in one of the level above.
    pub const GROUP: usize = 8;

    /// What the kernel can go down: enough for [`PRIMITIVE_LIMIT`](crate::scene::PRIMITIVE_LIMIT) solids under 64
    /// boxes.
    pub const MOST_LEVELS: u32 = 6;

    /// Over the solids of one kind.
    pub fn over(solids: usize) -> Self {
        let mut boxes = solids;
        let mut levels = 0;
        let most = |levels| if levels == 1 { Self::MOST_ALONE } else { Self::BREAK_EVEN };
        while boxes > most(levels) && levels < Self::MOST_LEVELS {
            boxes = boxes.div_ceil(Self::GROUP);
            levels += 1;
        }
        if levels == 0 { Self::None } else { Self::Hierarchy { levels } }
    }

    pub(super) fn decide(counts: [usize; 4], settings: &RenderSettings) -> Decision<[Self; 4]> {
        if !settings.algorithm.description().has_hierarchy {
            return Decision { choice: [Self::None; 4], reason: Reason::NoHierarchy };
        }
        if !settings.boxes {
            return Decision { choice: [Self::None; 4], reason: Reason::Asked };
        }
        let most = counts.into_iter().max().unwrap_or_default();
        let reason = if most > Self::BREAK_EVEN {
            Reason::ManySolids { solids: most, break_even: Self::BREAK_EVEN }
        } else {
            Reason::FewSolids { solids: most, break_even: Self::BREAK_EVEN }
        };
        Decision { choice: counts.map(Self::over), reason }
    }
}
