//! Frames survive the disk: exact values, whole files or none, clear refusals.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage, f16};
use tempfile::TempDir;
use zerkalo::frame::{Frame, FrameError, display_value};

fn frame_of(width: u32, height: u32, value: impl Fn(u32, u32) -> [f32; 3]) -> Frame {
    let mut frame = Frame::new(width, height).unwrap();
    for (index, pixel) in (0..).zip(frame.pixels_mut()) {
        *pixel = value(index % width, index / width);
    }
    frame
}

/// Incompressible values in [0, 1).
fn noise(width: u32, height: u32) -> Frame {
    let hash = |x: u32, y: u32, channel: u32| {
        let mut bits = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ channel.wrapping_mul(0xC2B2_AE3D);
        bits = (bits ^ (bits >> 15)).wrapping_mul(0x2C1B_3C6D);
        bits = (bits ^ (bits >> 12)).wrapping_mul(0x297A_2D39);
        (bits ^ (bits >> 15)) as f32 / 4_294_967_296.0
    };
    frame_of(width, height, |x, y| [hash(x, y, 1), hash(x, y, 2), hash(x, y, 3)])
}

fn bits(frame: &Frame) -> Vec<[u32; 3]> {
    frame.pixels().iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

fn names_in(folder: &Path) -> Vec<String> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

fn assert_one_line_about(error: &FrameError, path: &Path) {
    let message = error.to_string();
    assert!(!message.contains('\n'), "{message}");
    assert!(message.contains(&format!("{path:?}")), "{message}");
}

/// Writes a PNG of `width` x 1 pixels from its samples as they lie in the file.
fn write_png(path: &Path, width: u32, color: png::ColorType, depth: png::BitDepth, samples: &[u8]) {
    let mut encoder = png::Encoder::new(File::create(path).unwrap(), width, 1);
    encoder.set_color(color);
    encoder.set_depth(depth);
    encoder.write_header().unwrap().write_image_data(samples).unwrap();
}

#[test]
fn display_values_are_clamped_and_rounded_to_nearest() {
    let cases = [
        (0.0, 0),
        (-0.0, 0),
        (1.0, 255),
        (-3.0, 0),
        (1e30, 255),
        (f32::INFINITY, 255),
        (f32::NEG_INFINITY, 0),
        (f32::NAN, 0),
        (0.5, 128),
        (0.49 / 255.0, 0),
        (0.51 / 255.0, 1),
        (254.49 / 255.0, 254),
        (254.51 / 255.0, 255),
    ];
    for (linear, shown) in cases {
        assert_eq!(display_value(linear), shown, "{linear}");
    }
}

#[test]
fn png_keeps_display_values_and_the_place_of_every_pixel() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.png");
    let frame = frame_of(7, 5, |x, y| [x as f32 / 6.0, y as f32 / 4.0, 2.0 - x as f32]);
    frame.save(&path).unwrap();
    let shown = frame_of(7, 5, |x, y| {
        [x as f32 / 6.0, y as f32 / 4.0, 2.0 - x as f32].map(|value| f32::from(display_value(value)) / 255.0)
    });
    assert_eq!(Frame::load(&path).unwrap(), shown);
}

#[test]
fn exr_keeps_every_bit() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.EXR");
    let mut frame = noise(37, 41);
    let special = [
        [0.0, -0.0, -1.5],
        [f32::MAX, f32::MIN, f32::MIN_POSITIVE],
        [f32::from_bits(1), -f32::from_bits(0x007f_ffff), 1e-40],
        [f32::INFINITY, f32::NEG_INFINITY, f32::from_bits(0x7fc1_2345)],
    ];
    frame.pixels_mut()[100..104].copy_from_slice(&special);
    frame.save(&path).unwrap();
    assert_eq!(bits(&Frame::load(&path).unwrap()), bits(&frame));
}

#[test]
fn exr_with_half_samples_and_alpha_is_read() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("half.exr");
    let channels = SpecificChannels::rgba(|Vec2(x, y)| {
        (f16::from_f32(x as f32), f16::from_f32(y as f32), f16::from_f32(-0.5), f16::from_f32(0.25))
    });
    Image::from_channels((3, 2), channels).write().to_file(&path).unwrap();
    assert_eq!(Frame::load(&path).unwrap(), frame_of(3, 2, |x, y| [x as f32, y as f32, -0.5]));
}

#[test]
fn png_of_every_kind_is_read() {
    use png::{BitDepth, ColorType};
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("kind.png");
    let read = || Frame::load(&path).unwrap().pixels().to_vec();

    write_png(&path, 2, ColorType::Grayscale, BitDepth::Eight, &[0, 51]);
    assert_eq!(read(), [[0.0; 3], [0.2; 3]]);
    write_png(&path, 2, ColorType::GrayscaleAlpha, BitDepth::Eight, &[255, 7, 51, 0]);
    assert_eq!(read(), [[1.0; 3], [0.2; 3]]);
    write_png(&path, 1, ColorType::Rgba, BitDepth::Eight, &[255, 51, 0, 9]);
    assert_eq!(read(), [[1.0, 0.2, 0.0]]);
    write_png(&path, 8, ColorType::Grayscale, BitDepth::One, &[0b1000_0001]);
    assert_eq!(read()[..2], [[1.0; 3], [0.0; 3]]);
    write_png(&path, 1, ColorType::Rgb, BitDepth::Sixteen, &[0xff, 0xff, 0x33, 0x33, 0x00, 0x01]);
    assert_eq!(read(), [[1.0, 0.2, 1.0 / 65535.0]]);
    write_png(&path, 1, ColorType::GrayscaleAlpha, BitDepth::Sixteen, &[0x33, 0x33, 0x12, 0x34]);
    assert_eq!(read(), [[0.2; 3]]);
}

#[test]
fn impossible_sizes_are_refused() {
    for (width, height) in [(0, 5), (5, 0), (Frame::MAX_SIDE + 1, 1), (1, u32::MAX)] {
        let error = Frame::new(width, height).unwrap_err();
        assert!(error.is_input_error(), "{error}");
        assert!(error.to_string().contains(&format!("{width}x{height}")), "{error}");
    }
    assert_eq!(Frame::new(Frame::MAX_SIDE, 1).unwrap().pixels().len(), 16384);
}

#[test]
fn broken_images_are_input_errors() {
    let folder = TempDir::new().unwrap();
    for name in ["a.png", "a.exr"] {
        let path = folder.path().join(name);
        noise(20, 20).save(&path).unwrap();
        let whole = fs::read(&path).unwrap();
        let half = &whole[..whole.len() / 2];
        for broken in [&b""[..], b"garbage", &whole[..20], half] {
            fs::write(&path, broken).unwrap();
            let error = Frame::load(&path).unwrap_err();
            assert!(error.is_input_error(), "{error}");
            assert_one_line_about(&error, &path);
        }
        let missing = folder.path().join("missing").with_extension(path.extension().unwrap());
        for path in [missing, PathBuf::from("/"), folder.path().join("a.bmp")] {
            let error = Frame::load(&path).unwrap_err();
            assert!(error.is_input_error(), "{error}");
            assert_one_line_about(&error, &path);
        }
    }
}

#[test]
fn a_header_that_claims_a_huge_image_is_refused_at_once() {
    let folder = TempDir::new().unwrap();
    let png = folder.path().join("huge.png");
    drop(png::Encoder::new(File::create(&png).unwrap(), 60_000, 60_000).write_header().unwrap());

    let exr = folder.path().join("huge.exr");
    noise(4, 4).save(&exr).unwrap();
    let mut bytes = fs::read(&exr).unwrap();
    let key = b"dataWindow\0box2i\0";
    let value = bytes.windows(key.len()).position(|window| window == key).unwrap() + key.len() + 4;
    bytes[value + 8..value + 12].copy_from_slice(&999_999_999_i32.to_le_bytes());
    fs::write(&exr, bytes).unwrap();

    for path in [png, exr] {
        let error = Frame::load(&path).unwrap_err();
        assert!(error.is_input_error(), "{error}");
        assert_one_line_about(&error, &path);
        assert!(error.to_string().contains("impossible"), "{error}");
    }
}

#[test]
fn an_output_that_cannot_be_written_is_refused_before_the_render() {
    let folder = TempDir::new().unwrap();
    let taken = folder.path().join("taken.png");
    fs::create_dir(&taken).unwrap();
    let protected = folder.path().join("protected.png");
    fs::write(&protected, "old").unwrap();
    let mut permissions = fs::metadata(&protected).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&protected, permissions).unwrap();
    let before = names_in(folder.path());

    let unknown = [folder.path().join("a.jpg"), folder.path().join("png"), folder.path().join("a")];
    for path in &unknown {
        let error = Frame::check_output_path(path).unwrap_err();
        assert!(error.is_input_error(), "{error}");
        assert_one_line_about(&error, path);
    }
    let unwritable = [taken, protected.clone(), folder.path().join("missing/a.exr"), protected.join("a.png")];
    for path in &unwritable {
        let check = Frame::check_output_path(path).unwrap_err();
        let save = noise(2, 2).save(path).unwrap_err();
        assert_eq!(check.to_string(), save.to_string());
        assert!(!check.is_input_error(), "{check}");
        assert_one_line_about(&check, path);
    }
    Frame::check_output_path(&folder.path().join("new.png")).unwrap();
    assert_eq!(names_in(folder.path()), before);
    assert_eq!(fs::read(&protected).unwrap(), b"old");
}

/// A full disk is played by a limit on the size of files, which a child process sets for itself.
#[test]
fn a_failing_write_keeps_the_old_file_and_leaves_no_other() {
    const FOLDER: &str = "ZERKALO_TEST_LIMITED_FOLDER";
    if let Some(folder) = std::env::var_os(FOLDER) {
        for name in ["a.png", "a.exr"] {
            let error = noise(200, 200).save(&Path::new(&folder).join(name)).unwrap_err();
            assert!(!error.is_input_error(), "{error}");
            assert!(error.to_string().contains("File too large"), "{error}");
        }
        return;
    }
    let folder = TempDir::new().unwrap();
    for name in ["a.png", "a.exr"] {
        fs::write(folder.path().join(name), "old").unwrap();
    }
    let child = Command::new("bash")
        .args(["-c", r#"trap '' XFSZ; ulimit -f 16; exec "$0" --exact "$1""#])
        .arg(std::env::current_exe().unwrap())
        .arg("frame::a_failing_write_keeps_the_old_file_and_leaves_no_other")
        .env(FOLDER, folder.path())
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success() && told.contains("1 passed"), "{told}");
    let mut names = names_in(folder.path());
    names.sort();
    assert_eq!(names, ["a.exr", "a.png"]);
    for name in names {
        assert_eq!(fs::read(folder.path().join(name)).unwrap(), b"old");
    }
}

#[cfg(unix)]
#[test]
fn a_saved_file_has_the_permissions_and_the_place_of_a_plain_write() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = TempDir::new().unwrap();
    let mode = |name: &str| fs::metadata(folder.path().join(name)).unwrap().permissions().mode();

    fs::write(folder.path().join("plain"), "").unwrap();
    noise(2, 2).save(&folder.path().join("new.png")).unwrap();
    assert_eq!(mode("new.png"), mode("plain"));

    fs::set_permissions(folder.path().join("new.png"), PermissionsExt::from_mode(0o640)).unwrap();
    noise(2, 2).save(&folder.path().join("new.png")).unwrap();
    assert_eq!(mode("new.png") & 0o777, 0o640);

    symlink("new.png", folder.path().join("link.png")).unwrap();
    noise(3, 3).save(&folder.path().join("link.png")).unwrap();
    assert!(fs::symlink_metadata(folder.path().join("link.png")).unwrap().is_symlink());
    assert_eq!(Frame::load(&folder.path().join("new.png")).unwrap().width(), 3);
}

#[test]
fn every_golden_loads_in_its_size() {
    let goldens = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/goldens");
    let mut loaded = 0;
    for entry in fs::read_dir(goldens).unwrap() {
        let folder = entry.unwrap().path();
        let size: serde_json::Value = serde_json::from_slice(&fs::read(folder.join("size.json")).unwrap()).unwrap();
        let frame = Frame::load(&folder.join("course.exr")).unwrap();
        assert_eq!(
            [frame.width(), frame.height()],
            [&size["width"], &size["height"]].map(|n| n.as_u64().unwrap() as u32)
        );
        assert!(frame.pixels().iter().flatten().all(|value| value.is_finite()), "{folder:?}");
        loaded += 1;
    }
    assert!(loaded > 10, "only {loaded} goldens");
}
