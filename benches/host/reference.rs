//! The accurate model in `f64` on the CPU.

use std::ops::ControlFlow;

use criterion::{Criterion, Throughput};
use zerkalo::reference;

/// Small pictures on all cores: its time is per pixel.
pub fn benches(criterion: &mut Criterion) {
    const SIZE: [u32; 2] = [162, 70];
    let mut group = criterion.benchmark_group("reference");
    group.throughput(Throughput::Elements(u64::from(SIZE[0] * SIZE[1])));
    for name in ["four", "corridor", "showcase", "grid-cone-100"] {
        let scene = crate::scene(name);
        group.bench_function(name, |bencher| {
            bencher.iter(|| reference::render(&scene, SIZE[0], SIZE[1], &|_| ControlFlow::Continue(())));
        });
    }
    group.finish();
}
