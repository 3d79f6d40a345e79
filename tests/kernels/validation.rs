//! Nothing that the program draws makes the validation layers speak: each kind of its checks.

use std::ops::ControlFlow;
use std::process::Command;
use std::sync::Arc;

use crate::common::{TestDevice, render};
use zerkalo::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, Check, Commands, ComputePipeline, PIXEL_BYTES, PipelineDescription,
    Resource, StorageImage, Use, Validation, shaders, try_checks,
};
use zerkalo::scene::gallery;
use zerkalo::tracer::{Kernel, Precision, Settings, Tracer, course};

/// Small pictures at the scenes' own depth: the checks are per command and per access, not per pixel, and every
/// scene's records and loops are gone through whole. Two of the tiles' sides end inside a workgroup. In the order of
/// their depths, each of which makes a pipeline, since instrumented ones take long to compile.
#[test]
fn every_gallery_scene_is_drawn_without_a_message() {
    let device = TestDevice::open_with(Validation::GpuAssisted);
    let settings = Settings { max_tile_side: 40, ..Settings::new(64, 28) };
    let entries = gallery::entries();
    let mut scenes: Vec<_> = entries.iter().map(|entry| (&entry.name, gallery::scene(&entry.name).unwrap())).collect();
    // Two are of the accurate model only.
    scenes.retain(|(_, scene)| course::check(scene).is_ok());
    assert_eq!(scenes.len(), 52);
    scenes.sort_by_key(|(_, scene)| scene.max_depth);
    let mut tracer = Tracer::new(&device, &scenes[0].1, &settings).unwrap();
    for (name, scene) in scenes {
        tracer.set_scene(&scene, &settings).unwrap();
        tracer.render(&mut tracer.frame().unwrap(), &mut |_| ControlFlow::Continue(())).unwrap();
        assert_eq!(device.take_messages(), [], "{name}");
    }
}

/// Samples read the picture that the ones before them wrote, and upscaling reads what all of them did.
#[test]
fn samples_and_a_smaller_picture_are_drawn_without_a_message() {
    let device = TestDevice::open();
    let scene = gallery::scene("four").unwrap();
    for precision in [Precision::F32, Precision::F64] {
        for (samples, scale) in [(3, 1.0), (1, 0.3), (2, 0.5)] {
            let kernel = Kernel::Whitted(precision);
            render(&device, &scene, &Settings { kernel, samples, scale, max_tile_side: 40, ..Settings::new(93, 51) });
            assert_eq!(device.take_messages(), [], "{precision:?}, {samples} samples, scale {scale}");
        }
    }
}

#[test]
fn render_under_every_kind_of_validation_counts_no_message_and_succeeds() {
    let folder = tempfile::tempdir().unwrap();
    for option in ["", "=core", "=gpu-assisted", "=best-practices", "=all"] {
        let option = format!("--validate{option}");
        let arguments =
            ["render", "corridor", "-o", "corridor.png", "--size", "96x42", "--algorithm", "course", "--json"];
        let output = Command::new(env!("CARGO_BIN_EXE_zerkalo"))
            .args(arguments)
            .arg(&option)
            .current_dir(&folder)
            .output()
            .unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{option}: {stderr}");
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(report["validation_messages"], 0, "{option}");
        // What the layer says of itself is told with its reason, on standard error and in the report.
        let remarks = report["validation_remarks"].as_array().unwrap();
        assert_eq!(remarks.len(), stderr.lines().count(), "{stderr}");
        assert!(stderr.lines().all(|line| line.starts_with("no fault: ")), "{stderr}");
        assert_eq!(!remarks.is_empty(), ["--validate=best-practices", "--validate=all"].contains(&option.as_str()));
        assert!(folder.path().join("corridor.png").exists());
    }
}

/// Silence means something only where mistakes are told.
#[test]
fn every_kind_of_validation_tells_the_mistakes_that_it_is_for() {
    let wanted = std::env::var("ZERKALO_DEVICE").ok();
    for validation in [Validation::Core, Validation::GpuAssisted, Validation::BestPractices, Validation::All] {
        let tried = try_checks(wanted.as_deref(), validation).unwrap();
        assert_eq!(tried.iter().map(|(check, _)| *check).collect::<Vec<_>>(), Check::of(validation));
        let silent: Vec<_> = tried.iter().filter(|(_, works)| !works).collect();
        assert!(silent.is_empty(), "{validation:?}: {silent:?}");
    }
}

/// The silence above means something: the GPU-assisted checks are on.
#[test]
fn an_access_past_the_end_of_a_buffer_is_seen() {
    let device = TestDevice::open_with(Validation::GpuAssisted);
    let description = PipelineDescription {
        shader: &shaders::PROBE_SUM,
        bindings: &[BindingKind::Storage],
        push_constant_bytes: 0,
        constants: &[],
    };
    let pipeline = ComputePipeline::new(&device, &description).unwrap();
    // The kernel's 64 invocations take four bytes each. What lies past the end is the allocator's own block, so
    // that nothing is harmed on a device that does not hold the accesses back.
    let half = Buffer::new(&device, "half", BufferKind::Storage, 32 * 4).unwrap();
    let half = Resource::from(&Arc::new(half));
    let set = BindingSet::new(&pipeline, std::slice::from_ref(&half)).unwrap();
    Commands::new(&device, "past the end")
        .unwrap()
        .run(|recorder| {
            recorder.dispatch(&pipeline, &set, &[], [1, 1, 1]);
            recorder.make_ready(&half, Use::HostRead);
            Ok(())
        })
        .unwrap();
    let messages = device.take_messages();
    assert!(messages.iter().any(|message| message.text.contains("out of bounds")), "{messages:?}");
}

/// And so are the synchronization checks, of what they can see: two copies to one buffer.
#[test]
fn two_copies_without_a_barrier_are_seen_by_the_layer_too() {
    let device = TestDevice::open();
    let picture = Resource::from(&Arc::new(StorageImage::new(&device, "picture", 8, 8).unwrap()));
    let bytes = 8 * 8 * PIXEL_BYTES;
    let pixels = Resource::from(&Arc::new(Buffer::new(&device, "pixels", BufferKind::Readback, bytes).unwrap()));
    Commands::new(&device, "two copies")
        .unwrap()
        .run(|recorder| {
            recorder.make_ready(&picture, Use::CopySource);
            recorder.make_ready(&pixels, Use::CopyTarget);
            recorder.copy_to_buffer(&picture, &pixels, 8, 8);
            recorder.copy_to_buffer(&picture, &pixels, 8, 8);
            recorder.make_ready(&pixels, Use::HostRead);
            Ok(())
        })
        .unwrap();
    let ids: Vec<_> = device.take_messages().into_iter().map(|message| message.id).collect();
    for id in ["zerkalo-hazard", "SYNC-HAZARD-WRITE-AFTER-WRITE"] {
        assert!(ids.iter().any(|seen| seen == id), "{id} is not among {ids:?}");
    }
}
