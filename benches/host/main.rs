//! What the host does before and beside the device: `cargo bench`, or `cargo bench -- GROUP` for one group.
//!
//! How fast the device draws is measured by the program itself (`zerkalo fps`, `zerkalo trade`), which knows its clock.

mod plan;
mod reference;
mod scene_file;
mod structure;
mod upload;

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use zerkalo::scene::{Scene, gallery};

/// A ready scene, which there must be.
fn scene(name: &str) -> Scene {
    gallery::scene(name).unwrap_or_else(|| panic!("the gallery has no scene '{name}'"))
}

/// All groups together take about two minutes.
fn measured() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2))
        .without_plots()
}

criterion_group! {
    name = host;
    config = measured();
    targets = scene_file::benches, plan::benches, structure::benches, upload::benches, reference::benches
}
criterion_main!(host);
