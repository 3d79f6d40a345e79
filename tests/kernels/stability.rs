//! Every id of the catalogue of extremes (docs/numerics.md) is tried, and the accurate kernels pass it.

use std::collections::HashSet;
use std::ops::ControlFlow;

use crate::common::TestDevice;
use zerkalo::measure::stability::{Subject, Verdict, catalogue, error_sheet};
use zerkalo::tracer::{Kernel, Precision};

/// The ids of docs/numerics.md, and SC and TR once more as pictures.
fn wanted() -> Vec<String> {
    let numbered = [
        ("SC", 13),
        ("TR", 4),
        ("DS", 7),
        ("GR", 6),
        ("TC", 5),
        ("FB", 3),
        ("BX", 7),
        ("KN", 10),
        ("TG", 1),
        ("CF", 1),
        ("IN", 4),
        ("ON", 6),
        ("LT", 3),
        ("DG", 12),
        ("MR", 2),
        ("IT", 1),
        ("IM", 3),
        ("FV", 2),
        ("WD", 6),
        ("MS", 1),
        ("LP", 4),
        ("LR", 1),
        ("RF", 17),
        ("EX", 3),
        ("AT", 4),
        ("AL", 4),
    ];
    let mut ids: Vec<String> = numbered
        .iter()
        .flat_map(|(group, count)| (1..=*count).map(move |number| format!("{group}-{number}")))
        .collect();
    ids.extend(["N-0", "N-5", "RD-0", "SC-picture", "TR-picture"].map(str::to_owned));
    ids
}

#[test]
fn every_id_is_there_once() {
    let cases = catalogue();
    let ids: HashSet<String> = cases.iter().map(|case| case.id.clone()).collect();
    assert_eq!(ids.len(), cases.len(), "an id is there twice");
    assert_eq!(ids, wanted().into_iter().collect());
}

/// By id; cases that are not for the kernel are left out.
fn verdicts(kernel: Kernel) -> Vec<(String, Verdict)> {
    let device = TestDevice::open();
    let subject = Subject::new(&device, kernel, true);
    let tried = catalogue().into_iter().filter_map(|case| Some((case.id.clone(), case.try_kernel(&subject).unwrap()?)));
    tried.collect()
}

fn all_pass(precision: Precision) {
    let verdicts = verdicts(Kernel::Whitted(precision));
    let failed: Vec<_> = verdicts.iter().filter(|(_, verdict)| !verdict.passes()).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    // All but those of the loader.
    assert_eq!(verdicts.len(), wanted().len() - 12);
}

#[test]
fn the_accurate_kernel_passes_every_case_in_f32() {
    all_pass(Precision::F32);
}

#[test]
fn the_accurate_kernel_passes_every_case_in_f64() {
    all_pass(Precision::F64);
}

#[test]
fn impossible_scenes_are_refused_by_name() {
    let verdicts: Vec<_> = catalogue().iter().filter_map(|case| Some((case.id.clone(), case.try_loader()?))).collect();
    assert_eq!(verdicts.len(), 12);
    assert!(verdicts.iter().all(|(_, verdict)| verdict.passes()), "{verdicts:#?}");
}

/// Closed rooms are for path tracing alone: what a mirror shows that the camera does not see is background in screen
/// space.
#[test]
fn screen_space_and_path_tracing_pass_what_is_for_every_algorithm() {
    let of_all = ["N-0", "IM-3", "FV-1", "FV-2", "AL-1", "AL-2", "AL-3", "AL-4"];
    for (kernel, more) in [(Kernel::Ssr, &[][..]), (Kernel::Path(Precision::F32), &["MR-1"])] {
        let verdicts = verdicts(kernel);
        let ids: HashSet<&str> = verdicts.iter().map(|(id, _)| id.as_str()).collect();
        assert_eq!(ids, of_all.iter().chain(more).copied().collect(), "{kernel:?}");
        let failed: Vec<_> = verdicts.iter().filter(|(_, verdict)| !verdict.passes()).collect();
        assert!(failed.is_empty(), "{kernel:?}: {failed:#?}");
    }
}

/// A catalogue that everything passes would prove nothing.
#[test]
fn the_course_kernel_and_plain_quadratics_fail_where_they_are_known_to() {
    let device = TestDevice::open();
    let course = ["DS-4", "TC-3", "KN-1", "KN-9", "IN-2", "IN-3", "ON-1", "SC-picture", "TR-picture", "MR-1", "IT-1"];
    let plain = ["DS-4", "DS-7", "TC-2", "TC-3", "KN-1", "KN-4"];
    for (kernel, ids) in [(Kernel::Course, &course[..]), (Kernel::Plain, &plain)] {
        let subject = Subject::new(&device, kernel, true);
        for case in catalogue().iter().filter(|case| ids.contains(&case.id.as_str())) {
            let verdict = case.try_kernel(&subject).unwrap().unwrap();
            assert!(!verdict.passes(), "{} by {}: {verdict:?}", case.id, kernel.name());
        }
    }
}

#[test]
fn the_sheet_shows_the_kernels_errors_apart() {
    let device = TestDevice::open();
    let mut told = Vec::new();
    let sheet = error_sheet(&device, &mut |done, total| {
        told.push((done, total));
        ControlFlow::Continue(())
    })
    .unwrap();
    let columns = if device.description().float64 { 5 } else { 4 };
    assert_eq!(sheet.width(), 12 + columns * 252);
    let maps = 6 * (columns as usize - 1);
    assert_eq!(told, (1..=maps).map(|done| (done, maps)).collect::<Vec<_>>());
    // The middle of the far sphere, in each column: large errors are light, small ones dark.
    let luminance = |column: u32| {
        let (x, y) = (12 + column * 252 + 100, 40 + 24 + 70);
        let pixel = sheet.pixels()[(y * sheet.width() + x) as usize];
        0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]
    };
    assert!(luminance(1) > 0.6 && luminance(2) > 0.4, "course {}, plain {}", luminance(1), luminance(2));
    assert!(luminance(3) < 0.35, "whitted f32 {}", luminance(3));

    let stopped = error_sheet(&device, &mut |_, _| ControlFlow::Break(()));
    assert!(stopped.is_err());
}
