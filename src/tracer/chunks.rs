//! A picture traced a chunk at a time: in which order, and how much at once. Pure: no Vulkan.

use super::tiles::Tile;
use crate::plan::{MOST_PIXELS, WORKGROUP};

/// What a picture is traced by, pixels along x and y: workgroups below each other, as many as an invocation has pixels
/// at most.
const BLOCK: [u32; 2] = [WORKGROUP[0], MOST_PIXELS * WORKGROUP[1]];

/// Goes through a picture's blocks, row by row, in an order that spreads over the whole picture early: what is
/// not yet traced anew lies between rows that are, and chunks of it cost much the same.
#[derive(Debug)]
pub(super) struct Sweep {
    /// Size of the picture, pixels.
    size: [u32; 2],
    /// Blocks in a row.
    columns: u32,
    /// Rows of blocks, in their turn.
    rows: Vec<u32>,
    /// Position in the sequence of all blocks.
    next: u64,
    left: u64,
}

impl Sweep {
    /// A sweep of a picture of so many pixels, with nothing left to do.
    pub fn new(size: [u32; 2]) -> Self {
        let [columns, rows] = [0, 1].map(|axis| size[axis].div_ceil(BLOCK[axis]));
        let bits = u32::BITS - rows.saturating_sub(1).leading_zeros();
        let reversed = |row: u32| if bits == 0 { 0 } else { row.reverse_bits() >> (u32::BITS - bits) };
        let rows = (0..1 << bits).map(reversed).filter(|row| *row < rows).collect();
        Self { size, columns, rows, next: 0, left: 0 }
    }

    /// Blocks.
    pub fn total(&self) -> u64 {
        u64::from(self.columns) * self.rows.len() as u64
    }

    /// Blocks.
    pub fn left(&self) -> u64 {
        self.left
    }

    /// From the first row on.
    pub fn start(&mut self) {
        self.next = 0;
        self.left = self.total();
    }

    /// All over again, but from where it is: however often this is asked for, every row has its turn.
    pub fn start_here(&mut self) {
        self.left = self.total();
    }

    /// The pixels of the next `count` blocks, or of those that are left.
    pub fn take(&mut self, count: u64) -> Vec<Tile> {
        let mut count = count.min(self.left);
        if count == self.total() && count > 0 {
            self.left = 0;
            return vec![Tile::whole(self.size)];
        }
        let mut parts = Vec::new();
        while count > 0 {
            let (row, column) = (self.next / u64::from(self.columns), self.next % u64::from(self.columns));
            let taken = count.min(u64::from(self.columns) - column);
            parts.push(self.blocks(column as u32, self.rows[row as usize], taken as u32));
            self.next = (self.next + taken) % self.total();
            self.left -= taken;
            count -= taken;
        }
        parts
    }

    /// The pixels of so many blocks side by side.
    fn blocks(&self, column: u32, row: u32, count: u32) -> Tile {
        let (x, y) = (column * BLOCK[0], row * BLOCK[1]);
        Tile { x, y, width: (count * BLOCK[0]).min(self.size[0] - x), height: BLOCK[1].min(self.size[1] - y) }
    }
}

/// How many blocks to trace at once, so that whoever waits for the device need not wait long.
#[derive(Debug)]
pub(super) struct Pace {
    blocks: u64,
    ns_per_block: Option<f64>,
}

impl Pace {
    /// Whoever waits for the device has at most [`InFlight::COUNT`](crate::gpu::InFlight::COUNT) chunks before him: a
    /// panel that takes a CPU device another 20 ms to draw answers within the 100 ms that people take for at once.
    const CHUNK_NS: f64 = 20e6;
    /// Before anything is known: little even at eight milliseconds each, more than the slowest kernel took on two
    /// cores.
    const FIRST_BLOCKS: u64 = 2;
    /// The next rows may be more expensive than the last: the pace rises no faster than this, and falls at once.
    const LARGEST_RISE: u64 = 4;

    /// Decay of the estimated time from chunk to chunk: rows differ tenfold, and after a cheap one comes an expensive
    /// one again.
    const MEMORY: f64 = 0.7;

    pub fn new() -> Self {
        Self { blocks: Self::FIRST_BLOCKS, ns_per_block: None }
    }

    pub fn blocks(&self) -> u64 {
        self.blocks
    }

    pub fn measured(&mut self, blocks: u64, time_ns: u64) {
        if blocks == 0 {
            return;
        }
        let measured = (time_ns.max(1) as f64) / blocks as f64;
        let ns_per_block = self.ns_per_block.map_or(measured, |last| measured.max(last * Self::MEMORY));
        self.ns_per_block = Some(ns_per_block);
        let fitting = (Self::CHUNK_NS / ns_per_block) as u64;
        self.blocks = fitting.clamp(1, (blocks.max(Self::FIRST_BLOCKS)) * Self::LARGEST_RISE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts how often the tiles take each pixel.
    fn count(tiles: &[Tile], seen: &mut [u32], columns: u32) {
        for &Tile { x, y, width, height } in tiles {
            for row in y..y + height {
                (x..x + width).for_each(|column| seen[(row * columns + column) as usize] += 1);
            }
        }
    }

    #[test]
    fn a_sweep_takes_every_pixel_once_in_chunks_of_any_size() {
        for [width, height] in [[1, 1], [33, 9], [7, 400], [104, 500], [405, 175]] {
            for blocks in [1, 2, 7, 64, 1000, u64::MAX] {
                let mut sweep = Sweep::new([width, height]);
                let mut seen = vec![0; (width * height) as usize];
                sweep.start();
                while sweep.left() > 0 {
                    count(&sweep.take(blocks), &mut seen, width);
                }
                assert!(seen.iter().all(|&times| times == 1), "{width}x{height} by {blocks}");
                assert_eq!(sweep.take(blocks), [], "nothing is left");
            }
        }
    }

    #[test]
    fn starting_over_all_the_time_still_reaches_every_row() {
        let [width, height] = [4 * BLOCK[0], 9 * BLOCK[1]];
        let mut sweep = Sweep::new([width, height]);
        let mut seen = vec![0; (width * height) as usize];
        sweep.start();
        for _ in 0..36 {
            count(&sweep.take(1), &mut seen, width);
            sweep.start_here();
        }
        assert!(seen.iter().all(|&times| times == 1), "{seen:?}");
    }

    #[test]
    fn the_first_rows_spread_over_the_picture() {
        let mut sweep = Sweep::new([BLOCK[0], 64 * BLOCK[1]]);
        sweep.start();
        let rows: Vec<u32> = sweep.take(4).iter().map(|part| part.y / BLOCK[1]).collect();
        assert_eq!(rows, [0, 32, 16, 48]);
    }

    #[test]
    fn a_picture_that_fits_is_one_part() {
        let mut sweep = Sweep::new([101, 500]);
        sweep.start();
        assert_eq!(sweep.take(1000), [Tile::whole([101, 500])]);
    }

    #[test]
    fn the_pace_follows_the_time_measured_up_slowly_and_down_at_once() {
        let mut pace = Pace::new();
        let mut groups = Vec::new();
        for _ in 0..8 {
            pace.measured(pace.blocks(), pace.blocks() * 100_000);
            groups.push(pace.blocks());
        }
        assert_eq!(groups, [8, 32, 128, 200, 200, 200, 200, 200], "100 µs each: 200 of them take 20 ms");
        pace.measured(200, 200_000_000);
        assert_eq!(pace.blocks(), 20);
        pace.measured(20, u64::MAX);
        assert_eq!(pace.blocks(), 1, "never nothing");
        (0..200).for_each(|_| pace.measured(pace.blocks(), 0));
        assert!(pace.blocks() > 1, "a clock that stands still");
    }

    #[test]
    fn a_dear_chunk_is_remembered_over_a_cheap_one() {
        let mut pace = Pace::new();
        pace.measured(16, 16_000_000);
        assert_eq!(pace.blocks(), 20);
        pace.measured(20, 20_000);
        assert_eq!(pace.blocks(), 28, "20 ms at 0.7 ms each");
    }
}
