//! Parts of a picture, in workgroups or blocks of them. Pure: no Vulkan.

use super::tiles::Tile;

/// Workgroups of a picture, or blocks of them: `groups` along x and y, from `first` on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    pub first: [u32; 2],
    pub groups: [u32; 2],
}

/// What one dispatch runs of a part: column `x * groups[2] + z` of row `y`, from `first` on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid {
    pub first: [u32; 3],
    pub groups: [u32; 3],
}

impl Part {
    /// Workgroups of so many pixels that cover an area, which begins with one of them.
    pub fn of_pixels(Tile { x, y, width, height }: Tile, group: [u32; 2]) -> Self {
        Self { first: [x / group[0], y / group[1]], groups: [width.div_ceil(group[0]), height.div_ceil(group[1])] }
    }

    /// What of it lies in `area`, and the rest.
    pub fn cut(self, area: Self) -> (Option<Self>, Vec<Self>) {
        let end = |part: Self, axis: usize| part.first[axis] + part.groups[axis];
        let low = [0, 1].map(|axis| self.first[axis].max(area.first[axis]));
        let high = [0, 1].map(|axis| end(self, axis).min(end(area, axis)));
        if low[0] >= high[0] || low[1] >= high[1] {
            return (None, vec![self]);
        }
        let between = |low: [u32; 2], high: [u32; 2]| Self { first: low, groups: [high[0] - low[0], high[1] - low[1]] };
        let ([left, top], [right, bottom]) = (self.first, [end(self, 0), end(self, 1)]);
        let mut rest = vec![
            between([left, top], [right, low[1]]),
            between([left, low[1]], [low[0], high[1]]),
            between([high[0], low[1]], [right, high[1]]),
            between([left, high[1]], [right, bottom]),
        ];
        rest.retain(|part| part.groups[0] > 0 && part.groups[1] > 0);
        (Some(between(low, high)), rest)
    }

    /// Dispatches for a device that gives each of so many threads one run of the workgroups, x first and z last, as
    /// Mesa's CPU drivers do. A run is then every n-th column, so that no thread is left with the part of a picture
    /// that takes longest: of runs of whole rows, one has the sky.
    pub fn shares(self, threads: u32) -> Vec<Grid> {
        let ([column, row], [columns, rows]) = (self.first, self.groups);
        let mut shares = threads.max(1);
        while shares > 1 && columns < 2 * shares {
            shares /= 2;
        }
        let rest = columns % shares;
        let even = Grid { first: [0, row, column], groups: [columns / shares, rows, shares] };
        let odd = Grid { first: [0, row, column + columns - rest], groups: [1, rows, rest] };
        let mut dispatches = vec![even, odd];
        dispatches.retain(|dispatch| !dispatch.groups.contains(&0));
        dispatches
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts in rows of so many columns how often parts take each.
    fn cover(parts: &[Part], seen: &mut [u32], columns: u32) {
        for Part { first: [x, y], groups: [width, height] } in parts {
            for row in *y..y + height {
                for column in *x..x + width {
                    seen[(row * columns + column) as usize] += 1;
                }
            }
        }
    }

    #[test]
    fn a_part_is_cut_in_what_lies_in_an_area_and_the_rest() {
        let part = Part { first: [3, 2], groups: [5, 4] };
        for first in [[0, 0], [3, 2], [4, 3], [7, 5], [8, 2], [0, 6]] {
            for groups in [[1, 1], [2, 2], [20, 3], [3, 20], [20, 20], [0, 4]] {
                let area = Part { first, groups };
                let (inside, outside) = part.cut(area);
                let mut seen = vec![0; 10 * 10];
                cover(&outside, &mut seen, 10);
                let is_in = |part: &Part, x: u32, y: u32| {
                    let place = [x, y];
                    (0..2).all(|i| (part.first[i]..part.first[i] + part.groups[i]).contains(&place[i]))
                };
                for (x, y) in (0..10).flat_map(|y| (0..10).map(move |x| (x, y))) {
                    let is_inside = inside.is_some_and(|inside| is_in(&inside, x, y));
                    assert_eq!(is_inside, is_in(&part, x, y) && is_in(&area, x, y), "{area:?}: {x} {y}");
                    let times = seen[(y * 10 + x) as usize] + u32::from(is_inside);
                    assert_eq!(times, u32::from(is_in(&part, x, y)), "{area:?}: {x} {y}");
                }
            }
        }
    }

    #[test]
    fn shares_are_the_part_once_and_each_of_them_has_columns_all_over_it() {
        for threads in [0, 1, 2, 3, 4, 16, 64] {
            for (columns, rows) in [(1, 1), (2, 1), (5, 2), (32, 4), (11, 3), (203, 11)] {
                let part = Part { first: [7, 3], groups: [columns, rows] };
                let mut seen = vec![0; 300 * 20];
                for Grid { first, groups } in part.shares(threads) {
                    for x in first[0]..first[0] + groups[0] {
                        for (y, z) in (0..groups[1]).flat_map(|y| (0..groups[2]).map(move |z| (y, z))) {
                            let column = x * groups[2] + first[2] + z;
                            seen[((first[1] + y) * 300 + column) as usize] += 1;
                        }
                    }
                }
                let mut all = vec![0; 300 * 20];
                cover(&[part], &mut all, 300);
                assert!(seen == all, "{columns}x{rows} for {threads}");
            }
        }
        let part = Part { first: [0, 0], groups: [33, 4] };
        assert_eq!(part.shares(4)[0], Grid { first: [0, 0, 0], groups: [8, 4, 4] });
        assert_eq!(part.shares(4)[1], Grid { first: [0, 0, 32], groups: [1, 4, 1] });
        assert_eq!(part.shares(1), [Grid { first: [0, 0, 0], groups: [33, 4, 1] }]);
    }
}
