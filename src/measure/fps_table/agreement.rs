//! What a table makes of the course work's conclusions from its own.

use serde::Serialize;

use super::Speeds;
use super::published::{CLAIMED_OF_SPHERES, CLAIMED_ORDER, published};
use crate::scene::SolidKind;

/// The note's claims, tested on a table. They are about the table's shape: seconds are the machine's.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Agreement {
    /// The largest number of solids that all kinds were measured with; the note speaks of 100. `None`: there is none,
    /// nor then an order or a ratio.
    pub count: Option<usize>,
    /// The kinds there, the fastest first.
    pub order: Option<Vec<SolidKind>>,
    /// Whether that is the note's order: cone, sphere, cylinder, box.
    pub order_agrees: Option<bool>,
    pub ratios: Vec<Ratio>,
    pub bends: Vec<Bend>,
    /// Kendall's τ between this table and the published one over the cells of both: 1 where they order all pairs of
    /// cells alike, −1 where all the other way round (M. G. Kendall, A New Measure of Rank Correlation, 1938).
    /// `None` for fewer than two cells.
    pub rank_correlation: Option<f64>,
}

/// A kind's speed in parts of that of as many spheres.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ratio {
    pub kind: SolidKind,
    /// The note's, with 100 solids.
    pub claimed: f64,
    pub found: Option<f64>,
    /// Whether the kind is on the claimed side of the spheres.
    pub agrees: Option<bool>,
}

/// How the curve of a kind bends over the number of solids; see [`bend`]. Each is `None` for fewer than three numbers.
///
/// The note says that the frames "decrease with acceleration", for every solid adds reflections. Of the time of a frame
/// that is so where its curve bends up; of the frames a second only where theirs bends down.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bend {
    pub kind: SolidKind,
    pub frame_time: Option<f64>,
    pub frames_per_second: Option<f64>,
}

impl Agreement {
    pub fn of(speeds: &Speeds) -> Self {
        let fastest_first = |count| fastest_first(speeds, count);
        let count = speeds.counts().filter(|&count| fastest_first(count).is_some()).last();
        let order = count.and_then(fastest_first);
        let ratios = CLAIMED_OF_SPHERES.map(|(kind, claimed)| {
            let found = count.and_then(|count| speeds.of_spheres(kind, count));
            Ratio { kind, claimed, found, agrees: found.map(|found| (found > 1.0) == (claimed > 1.0)) }
        });
        let bends = SolidKind::ALL.map(|kind| {
            let points =
                |y: fn(f64) -> f64| speeds.of_kind(kind).map(|(n, fps)| (n as f64, y(fps))).collect::<Vec<_>>();
            Bend { kind, frame_time: bend(&points(|fps| 1.0 / fps)), frames_per_second: bend(&points(|fps| fps)) }
        });
        Self {
            count,
            order_agrees: order.as_ref().map(|order| *order == CLAIMED_ORDER),
            order,
            ratios: ratios.into(),
            bends: bends.into(),
            rank_correlation: rank_correlation(&pairs(speeds, &published())),
        }
    }

    /// Numbers of kinds: those whose curve of frame times has a known bend, and those of them where it bends up.
    pub fn ever_slower(&self) -> (usize, usize) {
        tally(self.bends.iter().filter_map(|bend| bend.frame_time), |bend| bend > 0.0)
    }

    /// Numbers of kinds: those whose curve of frames a second has a known bend, and those of them where it bends down.
    pub fn ever_steeper(&self) -> (usize, usize) {
        tally(self.bends.iter().filter_map(|bend| bend.frames_per_second), |bend| bend < 0.0)
    }
}

fn tally(bends: impl Iterator<Item = f64>, is_so: impl Fn(f64) -> bool) -> (usize, usize) {
    bends.fold((0, 0), |(all, so), bend| (all + 1, so + usize::from(is_so(bend))))
}

/// `None` where a kind was not measured.
fn fastest_first(speeds: &Speeds, count: usize) -> Option<Vec<SolidKind>> {
    let mut order: Vec<_> =
        SolidKind::ALL.into_iter().map(|kind| Some((kind, speeds.get(kind, count)?))).collect::<Option<_>>()?;
    order.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    Some(order.into_iter().map(|(kind, _)| kind).collect())
}

/// The parabola of least squares through the points: how far its midpoint hangs below the chord between its ends, in
/// parts of the mean of the values. Above 0 the curve bends up. All points count, so that no single one decides.
/// `None` for fewer than three different abscissas.
fn bend(points: &[(f64, f64)]) -> Option<f64> {
    let count = points.len() as f64;
    let mean = |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|&(x, y)| of(x, y)).sum::<f64>() / count;
    let (x_mean, y_mean) = (mean(&|x, _| x), mean(&|_, y| y));
    // The quadratic coefficient is y's projection on what the line through (x, x²) leaves of x².
    let variance = mean(&|x, _| (x - x_mean).powi(2));
    let skew = mean(&|x, _| (x - x_mean).powi(3));
    let rest = |x: f64| (x - x_mean).powi(2) - variance - skew / variance * (x - x_mean);
    let rest_squared = mean(&|x, _| rest(x).powi(2));
    let first = points.iter().map(|point| point.0).min_by(f64::total_cmp)?;
    let last = points.iter().map(|point| point.0).max_by(f64::total_cmp)?;
    let half = (last - first) / 2.0;
    // With two abscissas the rest is rounding, some 1e-16 of the half width's square.
    let is_determined = rest_squared > (1e-12 * half.powi(2)).powi(2);
    let coefficient = mean(&|x, y| rest(x) * (y - y_mean)) / rest_squared;
    // y = c·x² hangs c·half² below its chord at the midpoint.
    is_determined.then(|| coefficient * half.powi(2) / y_mean)
}

/// The frames a second of both tables, cell by cell.
fn pairs(ours: &Speeds, theirs: &Speeds) -> Vec<(f64, f64)> {
    let cells = SolidKind::ALL.into_iter().flat_map(|kind| ours.of_kind(kind).map(move |(n, fps)| (kind, n, fps)));
    cells.filter_map(|(kind, count, fps)| Some((fps, theirs.get(kind, count)?))).collect()
}

/// Pairs of cells ordered alike less those ordered otherwise, in parts of all pairs.
fn rank_correlation(cells: &[(f64, f64)]) -> Option<f64> {
    let mut sum = 0.0;
    for (place, a) in cells.iter().enumerate() {
        for b in &cells[place + 1..] {
            let sign = |difference: f64| if difference == 0.0 { 0.0 } else { difference.signum() };
            sum += sign(a.0 - b.0) * sign(a.1 - b.1);
        }
    }
    (cells.len() > 1).then(|| sum / (cells.len() * (cells.len() - 1) / 2) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_table_bears_out_the_notes_order_and_ratios() {
        let agreement = Agreement::of(&published());
        assert_eq!((agreement.count, agreement.order_agrees), (Some(100), Some(true)));
        assert_eq!(agreement.order.as_deref(), Some(&CLAIMED_ORDER[..]));
        for ratio in &agreement.ratios {
            let found = ratio.found.unwrap();
            assert_eq!(ratio.agrees, Some(true), "{ratio:?}");
            // The note gives three digits, and 1.693 as 1.70.
            assert!((found / ratio.claimed - 1.0).abs() < 0.005, "{ratio:?}");
        }
        assert_eq!(agreement.rank_correlation, Some(1.0));
    }

    /// The note's "decrease with acceleration" holds of the time of a frame, not of the frames a second.
    #[test]
    fn in_the_published_table_frames_take_ever_longer_but_do_not_fall_ever_faster() {
        let agreement = Agreement::of(&published());
        assert_eq!(agreement.ever_slower(), (4, 4), "{:?}", agreement.bends);
        assert_eq!(agreement.ever_steeper(), (4, 0), "{:?}", agreement.bends);
    }

    #[test]
    fn the_bend_is_that_of_the_parabola_through_the_points() {
        let parabola = |x: f64| 3.0 + 2.0 * x + 0.5 * x * x;
        for places in [&[1.0, 2.0, 5.0][..], &[10.0, 20.0, 30.0, 40.0, 100.0]] {
            let points: Vec<_> = places.iter().map(|&x| (x, parabola(x))).collect();
            let mean = points.iter().map(|(_, y)| y).sum::<f64>() / points.len() as f64;
            let half = (places[places.len() - 1] - places[0]) / 2.0;
            let expected = 0.5 * half * half / mean;
            // Sums of at most five terms and a quotient of two of them: far less than 100 roundings.
            assert!((bend(&points).unwrap() / expected - 1.0).abs() < 100.0 * f64::EPSILON, "{places:?}");
        }
        assert_eq!(bend(&[]), None);
        assert_eq!(bend(&[(1.0, 2.0)]), None);
        assert_eq!(bend(&[(10.0, 2.0), (20.0, 7.0)]), None);
        assert_eq!(bend(&[(10.0, 2.0), (20.0, 7.0), (20.0, 8.0)]), None);
    }

    #[test]
    fn rank_correlation_counts_pairs_ordered_alike() {
        assert_eq!(rank_correlation(&[(1.0, 1.0)]), None);
        assert_eq!(rank_correlation(&[(1.0, 10.0), (2.0, 30.0), (3.0, 20.0)]), Some(1.0 / 3.0));
        assert_eq!(rank_correlation(&[(1.0, 3.0), (2.0, 2.0), (3.0, 1.0)]), Some(-1.0));
        assert_eq!(rank_correlation(&[(1.0, 3.0), (1.0, 2.0)]), Some(0.0));
    }

    #[test]
    fn of_a_table_that_lacks_kinds_nothing_is_claimed() {
        let mut speeds = Speeds::default();
        assert_eq!(Agreement::of(&speeds).count, None);
        SolidKind::ALL.into_iter().for_each(|kind| speeds.set(kind, 10, 1.0 + kind as usize as f64));
        speeds.set(SolidKind::Sphere, 20, 5.0);
        let agreement = Agreement::of(&speeds);
        assert_eq!((agreement.count, agreement.order_agrees), (Some(10), Some(false)));
        assert_eq!((agreement.ever_slower(), agreement.ever_steeper()), ((0, 0), (0, 0)));
        assert!(agreement.ratios.iter().any(|ratio| ratio.agrees == Some(false)));
    }
}
