//! A made-up measurement for tests.

use super::{Conditions, Counted, EdgeError, LeftOut, PictureError, Point, SceneTrade, Target, Trade};
use crate::algorithm::Algorithm;
use crate::measure::{Budget, Clock, ImageError, Machine};
use crate::plan::Precision;
use crate::settings::RenderSettings;

/// One scene: the baseline at 10 ms, f64 at 20, a bounded and a measured setting at 5 and 2.5, and one with NaN at 1.
pub fn example() -> Trade {
    let f32 = RenderSettings { precision: Some(Precision::F32), ..RenderSettings::default() };
    let f64 = RenderSettings { precision: Some(Precision::F64), ..f32 };
    let plain = RenderSettings { algorithm: Algorithm::Plain, ..f32 };
    let points = vec![
        point(f32, Some(0.0), 0.002, 10.0),
        point(f64, Some(0.0), 3e-8, 20.0),
        point(RenderSettings { error: 1.0 / 255.0, ..f32 }, Some(0.003), 0.001, 5.0),
        point(RenderSettings { max_depth: Some(2), ..f32 }, None, 0.2, 2.5),
        point(plain, None, f64::INFINITY, 1.0),
    ];
    let course = RenderSettings { algorithm: Algorithm::Course, precision: None, ..f32 };
    let scene = SceneTrade {
        scene: "room".to_owned(),
        solids: 7,
        max_depth: 20,
        clock: Clock::Gpu,
        truth_standard_error: None,
        points,
        left_out: vec![LeftOut { setting: course, reason: "one light".to_owned() }],
        complete: true,
    };
    Trade {
        machine: Machine {
            device: "a device".into(),
            driver: "driver 1".into(),
            program: "z 1".into(),
            present_mode: None,
        },
        conditions: Conditions {
            width: 160,
            height: 70,
            target: Target::Point,
            counted: Counted::AllPixels,
            budget: Budget::QUICK,
            validation: false,
            questions: Vec::new(),
        },
        scenes: vec![scene],
    }
}

fn point(setting: RenderSettings, bound: Option<f64>, error: f64, time_ms: f64) -> Point {
    let is_finite = error.is_finite();
    let image = ImageError {
        rmse: Some(error / 4.0).filter(|_| is_finite),
        max_abs: Some(error).filter(|_| is_finite),
        psnr_db: Some(-20.0 * (error / 4.0).log10()).filter(|_| is_finite),
        flip_mean: 0.01,
        differing_pixels: 100,
        non_finite_pixels: if is_finite { 0 } else { 3 },
        pixels: 160 * 70,
    };
    Point {
        setting,
        bound,
        error: PictureError {
            image,
            edges: Some(EdgeError {
                max_abs_off_discontinuities: Some(error / 10.0).filter(|_| is_finite),
                discontinuity_pixels: 200,
                differing_discontinuity_pixels: 10,
            }),
        },
        rmse_of_pictures: Vec::new(),
        baseline_samples_ns: vec![10_000_000; 3],
        samples_ns: [0.9, 1.0, 1.1].map(|times| (times * time_ms * 1e6) as u64).to_vec(),
    }
}
