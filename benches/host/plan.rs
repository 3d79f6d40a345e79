//! What a scene requires, and what an allowed error leaves out.

use criterion::Criterion;
use zerkalo::plan::{Limits, Plan};
use zerkalo::settings::RenderSettings;

pub fn benches(criterion: &mut Criterion) {
    // Arrays that the scenes fit.
    let limits = Limits { max_array_bytes: 1 << 27, ..Limits::PROMISED };
    let exact = RenderSettings::default();
    let cut = RenderSettings { error: 1.0 / 510.0, ..exact };
    let mut group = criterion.benchmark_group("plan");
    for name in ["grid-cone-100", "cloud-10000"] {
        let scene = crate::scene(name);
        for (what, settings) in [("exact", &exact), ("error 1/510", &cut)] {
            let id = format!("{name}, {what}");
            group
                .bench_function(id, |bencher| bencher.iter(|| Plan::for_scene(&scene, settings, [1621, 701], &limits)));
        }
    }
    group.finish();
}
