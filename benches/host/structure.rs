//! Boxes over solids, and the records that the accurate kernel reads.

use criterion::{Criterion, Throughput};
use rayon::prelude::*;
use zerkalo::scene::{Bounds, SceneSpace};
use zerkalo::tracer::Precision;
use zerkalo::tracer::whitted::{
    WhittedRecords,
    hierarchy::{levels, order},
};

pub fn benches(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("structure");
    for name in ["grid-cone-100", "squares-100000", "cloud-100000"] {
        let scene = crate::scene(name);
        let frame = SceneSpace::of(&scene);
        let solids: Vec<Bounds> =
            scene.primitives.par_iter().map(|primitive| Bounds::of(&primitive.solid, frame)).collect();
        let ordered: Vec<Bounds> = order(&solids).into_iter().map(|place| solids[place as usize]).collect();
        group.throughput(Throughput::Elements(solids.len() as u64));
        group.bench_function(format!("{name}, order"), |bencher| bencher.iter(|| order(&solids)));
        group.bench_function(format!("{name}, levels"), |bencher| bencher.iter(|| levels(&ordered)));
        for precision in [Precision::F32, Precision::F64] {
            group.bench_function(format!("{name}, all records {}", precision.name()), |bencher| {
                bencher.iter(|| WhittedRecords::of(&scene, frame, precision, [1621, 701]));
            });
        }
    }
    group.finish();
}
