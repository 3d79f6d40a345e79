use serde::Serialize;

use super::{Algorithm, Cell, Clock, FpsTable, Speeds, frames_per_second, published};
use crate::measure::Summary;
use crate::scene::SolidKind;

/// A cell in figures, the published ones beside. Ratios are by the table's [clock](FpsTable::clock).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figures {
    pub kind: SolidKind,
    /// Number of solids.
    pub count: usize,
    pub algorithm: Algorithm,
    /// Frames a second by the median GPU time; null where the device has no timestamps, as all of the GPU.
    pub gpu_fps: Option<f64>,
    pub wall_fps: f64,
    pub gpu: Option<Summary>,
    pub wall: Summary,
    /// Null where the course work has no such cell.
    pub published_fps: Option<f64>,
    /// In parts of the speed with the table's fewest solids of the kind.
    pub of_fewest: Option<f64>,
    pub published_of_fewest: Option<f64>,
    /// In parts of the speed with as many spheres.
    pub of_spheres: Option<f64>,
    pub published_of_spheres: Option<f64>,
}

/// Figures of every cell, in the order of measuring.
pub fn figures(table: &FpsTable) -> Vec<Figures> {
    let published = published();
    let speeds: Vec<(Algorithm, Speeds)> =
        table.plan.algorithms.iter().map(|&algorithm| (algorithm, table.speeds(algorithm, table.clock()))).collect();
    let figures = table.cells.iter().filter_map(|cell| {
        let (_, speeds) = speeds.iter().find(|(kernel, _)| *kernel == cell.algorithm)?;
        of_cell(cell, speeds, &published, table.plan.fewest())
    });
    figures.collect()
}

/// `None` for a cell without samples.
fn of_cell(cell: &Cell, speeds: &Speeds, published: &Speeds, fewest: usize) -> Option<Figures> {
    let &Cell { kind, count, algorithm, .. } = cell;
    let fps = |summary: &Summary| frames_per_second(summary.median_ns as f64);
    let (gpu, wall) = (cell.summary(Clock::Gpu), cell.summary(Clock::Wall)?);
    Some(Figures {
        kind,
        count,
        algorithm,
        gpu_fps: gpu.as_ref().map(fps),
        wall_fps: fps(&wall),
        gpu,
        wall,
        published_fps: published.get(kind, count),
        of_fewest: speeds.of_fewest(kind, count, fewest),
        published_of_fewest: published.of_fewest(kind, count, fewest),
        of_spheres: speeds.of_spheres(kind, count),
        published_of_spheres: published.of_spheres(kind, count),
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::{BOTH, example};
    use super::*;

    #[test]
    fn ratios_stand_beside_the_published_ones() {
        let figures = figures(&example(&[10, 100], &BOTH));
        assert_eq!(figures.len(), 16);
        let cone = figures.iter().rfind(|figures| figures.algorithm == Algorithm::Course).unwrap();
        assert_eq!((cone.kind, cone.count), (SolidKind::Cone, 100));
        assert_eq!(cone.gpu_fps, Some(1e9 / 103e6));
        // 103 ms after 13 ms, and 100 ms of spheres: quotients of three roundings each.
        assert!((cone.of_fewest.unwrap() / (13.0 / 103.0) - 1.0).abs() < 4.0 * f64::EPSILON);
        assert!((cone.of_spheres.unwrap() / (100.0 / 103.0) - 1.0).abs() < 4.0 * f64::EPSILON);
        assert_eq!(cone.published_fps, Some(19.3409));
        assert_eq!(cone.published_of_fewest, Some(19.3409 / 55.4482));
        assert_eq!(cone.published_of_spheres, Some(19.3409 / 18.6406));
    }
}
