//! In which order the solids of a kind lie, and the boxes over them: what `glsl/search/hierarchy.glsl` goes down.
//!
//! Level 0 are the solids; box `j` of level `h` is around those from `j·8ʰ` on, 8ʰ of them or the rest. So the order is
//! the whole structure, and a solid that changes changes one box of each level.

use glam::DVec3;
use rayon::prelude::*;

use crate::plan::Structure;
use crate::scene::Bounds;

/// Boxes in a group, and solids in a box of level 1.
pub const GROUP: usize = Structure::GROUP;

/// Levels over so many solids of a kind.
pub fn level_count(solids: usize) -> usize {
    match Structure::over(solids) {
        Structure::None => 0,
        Structure::Hierarchy { levels } => levels as usize,
    }
}

/// One level over the solids.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Bounds of each group of the level below, in order.
    pub boxes: Vec<Bounds>,
    /// Axis along which the boxes of a group lie one behind the other, for each group.
    pub orders: Vec<usize>,
}

/// The order of the solids, as indices into `bounds`: neighbours in space are neighbours in it.
pub fn order(bounds: &[Bounds]) -> Vec<u32> {
    let mut places: Vec<(u32, DVec3)> = (0..).zip(bounds.iter().map(Bounds::middle)).collect();
    sort(&mut places);
    places.into_iter().map(|(place, _)| place).collect()
}

/// Cuts in two at a multiple of the largest power of eight that fits, across the longest side of the centres, and each
/// half again: no box of any level reaches over the cut.
fn sort(places: &mut [(u32, DVec3)]) {
    if places.len() <= 2 {
        return;
    }
    let mut block = 1;
    while block * GROUP < places.len() {
        block *= GROUP;
    }
    let blocks = places.len().div_ceil(block);
    let cut = blocks / 2 * block;
    let axis = longest_side(places.iter().map(|(_, middle)| *middle));
    let along = |(place, middle): &(u32, DVec3)| (middle[axis], *place);
    places.select_nth_unstable_by(cut, |a, b| {
        let (a, b) = (along(a), along(b));
        a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
    });
    let (low, high) = places.split_at_mut(cut);
    const WORTH_A_TASK: usize = 4096;
    if low.len() + high.len() > WORTH_A_TASK {
        rayon::join(|| sort(low), || sort(high));
    } else {
        sort(low);
        sort(high);
    }
}

fn longest_side(middles: impl Iterator<Item = DVec3>) -> usize {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for middle in middles {
        low = low.min(middle);
        high = high.max(middle);
    }
    let side = high - low;
    if side.x >= side.y && side.x >= side.z {
        0
    } else if side.y >= side.z {
        1
    } else {
        2
    }
}

/// The levels over solids that lie in [their order](order), from level 1 on.
pub fn levels(ordered: &[Bounds]) -> Vec<Level> {
    let mut levels: Vec<Level> = Vec::new();
    for _ in 0..level_count(ordered.len()) {
        let below = levels.last().map_or(ordered, |level| &level.boxes);
        let boxes: Vec<_> = below.par_chunks(GROUP).map(around).collect();
        let orders = boxes.par_chunks(GROUP).map(|group| longest_side(group.iter().map(Bounds::middle))).collect();
        levels.push(Level { boxes, orders });
    }
    levels
}

fn around(group: &[Bounds]) -> Bounds {
    group.iter().copied().fold(Bounds::EMPTY, Bounds::union)
}
