use crate::scene::SolidKind;

/// Frames a second by number of solids (rows, ascending) and kind (columns): table 4.1 or one like it. What was not
/// measured is absent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Speeds {
    rows: Vec<(usize, [Option<f64>; KINDS])>,
}

const KINDS: usize = SolidKind::ALL.len();

impl Speeds {
    pub fn set(&mut self, kind: SolidKind, count: usize, fps: f64) {
        let place = self.rows.binary_search_by_key(&count, |(count, _)| *count).unwrap_or_else(|place| {
            self.rows.insert(place, (count, [None; KINDS]));
            place
        });
        self.rows[place].1[kind as usize] = Some(fps);
    }

    pub fn get(&self, kind: SolidKind, count: usize) -> Option<f64> {
        let place = self.rows.binary_search_by_key(&count, |(count, _)| *count).ok()?;
        self.rows[place].1[kind as usize]
    }

    /// The numbers of solids that anything is known of, ascending.
    pub fn counts(&self) -> impl Iterator<Item = usize> + '_ {
        self.rows.iter().map(|(count, _)| *count)
    }

    /// Numbers and frames a second of one kind, by ascending number.
    pub fn of_kind(&self, kind: SolidKind) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.rows.iter().filter_map(move |(count, row)| Some((*count, row[kind as usize]?)))
    }

    /// What of the speed with `base` solids of the kind is left with `count` of them.
    pub fn of_fewest(&self, kind: SolidKind, count: usize, base: usize) -> Option<f64> {
        Some(self.get(kind, count)? / self.get(kind, base)?)
    }

    /// In parts of the speed with as many spheres.
    pub fn of_spheres(&self, kind: SolidKind, count: usize) -> Option<f64> {
        Some(self.get(kind, count)? / self.get(SolidKind::Sphere, count)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_sorted_and_what_was_not_measured_is_absent() {
        let mut speeds = Speeds::default();
        speeds.set(SolidKind::Cone, 100, 5.0);
        speeds.set(SolidKind::Cone, 10, 20.0);
        speeds.set(SolidKind::Sphere, 10, 40.0);
        assert_eq!(speeds.counts().collect::<Vec<_>>(), [10, 100]);
        assert_eq!(speeds.of_kind(SolidKind::Cone).collect::<Vec<_>>(), [(10, 20.0), (100, 5.0)]);
        assert_eq!(speeds.of_fewest(SolidKind::Cone, 100, 10), Some(0.25));
        assert_eq!(speeds.of_spheres(SolidKind::Cone, 10), Some(0.5));
        assert_eq!(speeds.of_spheres(SolidKind::Cone, 100), None);
        assert_eq!((speeds.get(SolidKind::Box, 10), speeds.get(SolidKind::Cone, 20)), (None, None));
    }
}
