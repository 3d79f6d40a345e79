//! From a file's text or bytes to a validated scene.

use criterion::{Criterion, Throughput};
use zerkalo::scene::Scene;

/// Ten thousand solids of all kinds as text, a hundred thousand as bytes: each takes some tens of milliseconds.
pub fn benches(criterion: &mut Criterion) {
    let scene = crate::scene("cloud-10000");
    let mut group = criterion.benchmark_group("scene file");
    let toml = scene.to_toml();
    group.throughput(Throughput::Bytes(toml.len() as u64));
    group.bench_function("TOML, 10000 solids", |bencher| bencher.iter(|| Scene::from_toml(&toml)));
    let json = scene.to_json();
    group.throughput(Throughput::Bytes(json.len() as u64));
    group.bench_function("JSON, 10000 solids", |bencher| bencher.iter(|| Scene::from_json(&json)));
    let large = crate::scene("cloud-100000");
    let zscene = large.to_zscene();
    group.throughput(Throughput::Bytes(zscene.len() as u64));
    group.bench_function(".zscene, 100000 solids", |bencher| bencher.iter(|| Scene::from_zscene(&zscene)));
    group.bench_function("to .zscene, 100000 solids", |bencher| bencher.iter(|| large.to_zscene()));
    group.finish();
}
