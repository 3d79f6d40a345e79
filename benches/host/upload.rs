//! From records to the device's memory.

use criterion::{Criterion, Throughput};
use zerkalo::gpu::{Device, Validation};
use zerkalo::plan::scene_space;
use zerkalo::tracer::Precision;
use zerkalo::tracer::whitted::{WhittedRecords, upload_scene};

/// Nothing where there is no device; `ZERKALO_DEVICE` chooses one.
pub fn benches(criterion: &mut Criterion) {
    let wanted = std::env::var("ZERKALO_DEVICE").ok();
    let device = match Device::open(wanted.as_deref(), Validation::Off) {
        Ok(device) => device,
        Err(error) => return eprintln!("upload: not measured, for {error}"),
    };
    let mut group = criterion.benchmark_group("upload");
    for name in ["grid-cone-100", "cloud-100000"] {
        let scene = crate::scene(name);
        for precision in [Precision::F32, Precision::F64] {
            let records = WhittedRecords::of(
                &scene,
                scene_space(&scene, zerkalo::tracer::Kernel::Whitted(precision)),
                precision,
                [1621, 701],
            );
            group.throughput(Throughput::Elements(scene.primitives.len() as u64));
            group.bench_function(format!("{name}, {}", precision.name()), |bencher| {
                bencher.iter(|| upload_scene(&device, &records, precision).map(|resources| resources.len()));
            });
        }
    }
    group.finish();
}
