//! How long a million solids take to load, to order and to turn into the kernel's records:
//! `cargo bench --bench structure`.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use rayon::prelude::*;
use zerkalo::measure::median;
use zerkalo::scene::{Scene, gallery};
use zerkalo::tracer::hierarchy::{Bounds, levels, order};
use zerkalo::tracer::{KernelFrame, Precision, WhittedRecords, bounds};

fn main() -> Result<(), Box<dyn Error>> {
    for name in ["squares-1000000", "cloud-sphere-1000000", "cloud-1000000"] {
        let scene = gallery::scene(name).ok_or("no such scene")?;
        let frame = KernelFrame::of(&scene);
        let solids: Vec<Bounds> =
            scene.primitives.par_iter().map(|primitive| bounds(&primitive.solid, frame)).collect();
        println!("{name}");
        let places = timed("order", || order(&solids));
        let ordered: Vec<Bounds> = places.iter().map(|&place| solids[place as usize]).collect();
        timed("levels", || levels(&ordered));
        timed("all records", || WhittedRecords::of(&scene, frame, Precision::F32, [1621, 701]));
        let bytes = timed("to .zscene", || scene.to_zscene());
        timed("from .zscene", || Scene::from_zscene(&bytes)).map(drop)?;
        println!("  {:<13} {:8.1} MB", ".zscene", bytes.len() as f64 / 1e6);
    }
    Ok(())
}

/// The median of a few, after one that is not counted.
fn timed<T>(what: &str, mut work: impl FnMut() -> T) -> T {
    const RUNS: usize = 5;
    let mut result = black_box(work());
    let mut samples_ns = Vec::new();
    for _ in 0..RUNS {
        let start = Instant::now();
        let next = black_box(work());
        samples_ns.push(start.elapsed().as_nanos() as u64);
        result = next;
    }
    let milliseconds = median(&samples_ns).unwrap_or_default() as f64 / 1e6;
    println!("  {what:<13} {milliseconds:8.1} ms");
    result
}
