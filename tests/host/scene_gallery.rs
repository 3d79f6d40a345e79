//! The gallery and its files under `scenes/`.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use glam::DVec3;
use zerkalo::scene::gallery;
use zerkalo::scene::{Projection, Scene, Solid, SolidKind};

fn made(name: &str) -> Scene {
    gallery::scene(name).unwrap_or_else(|| panic!("no scene {name}"))
}

#[test]
fn every_gallery_scene_has_its_own_name_and_is_valid() {
    let entries = gallery::entries();
    let names: HashSet<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
    assert_eq!(names.len(), entries.len());
    assert_eq!(entries.len(), 18 + 4 * 10);
    for entry in &entries {
        made(&entry.name).validate().unwrap_or_else(|error| panic!("{}: {error}", entry.name));
        for about in [&entry.english, &entry.russian] {
            assert!(!about.is_empty() && !about.contains('\n'), "{about:?}");
        }
    }
    assert_eq!(gallery::scene("no such scene"), None);
}

#[test]
fn committed_scene_files_are_what_the_gallery_writes() {
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    if std::env::var_os("ZERKALO_BLESS").is_some() {
        fs::create_dir_all(&committed).unwrap();
        gallery::write_all(&committed).unwrap();
    }
    let fresh = tempfile::tempdir().unwrap();
    gallery::write_all(fresh.path()).unwrap();
    for entry in gallery::entries() {
        let file = entry.name + ".toml";
        let read = |folder: &Path| fs::read_to_string(folder.join(&file)).unwrap_or_default().replace("\r\n", "\n");
        assert!(
            read(&committed) == read(fresh.path()),
            "scenes/{file} is not what the gallery writes; to write it anew: \
             ZERKALO_BLESS=1 cargo test --test scene_gallery"
        );
    }
}

#[test]
fn gallery_files_load_to_the_scenes_that_were_written() {
    let folder = tempfile::tempdir().unwrap();
    gallery::write_all(folder.path()).unwrap();
    for entry in gallery::entries() {
        let loaded = Scene::load(&folder.path().join(format!("{}.toml", entry.name))).unwrap();
        assert_eq!(format!("{loaded:?}"), format!("{:?}", made(&entry.name)));
    }
}

#[test]
fn grids_stand_as_table_4_1_has_them() {
    for kind in SolidKind::ALL {
        for count in (10..=100).step_by(10) {
            let scene = made(&format!("grid-{}-{count}", kind.name()));
            assert_eq!(scene.primitives.len(), count);
            assert_eq!((scene.max_depth, scene.camera.projection), (20, Projection::Course));
            assert_eq!(scene.lights[0].position, DVec3::new(1.0, 2.0, 0.0));
            assert!((scene.camera.position - DVec3::new(2.725234, 4.098764, -4.858740)).length() < 1e-6);
            for (i, primitive) in scene.primitives.iter().enumerate() {
                assert_eq!(primitive.solid.kind(), kind);
                let expected = DVec3::new((2 * (i / 10)) as f64, 0.0, (2 * (i % 10)) as f64);
                assert_eq!(primitive.solid.position(), expected, "{kind:?} {i}");
            }
        }
    }
}

#[test]
fn grid_cylinders_keep_the_default_shape_where_they_stand() {
    let scene = made("grid-cylinder-20");
    let Solid::Cylinder { ends, radius } = &scene.primitives[11].solid else { panic!("not a cylinder") };
    assert_eq!((ends, *radius), (&[DVec3::new(3.0, 0.0, 3.0), DVec3::new(1.0, 0.0, 1.0)], 1.0));
}

#[test]
fn showcase_has_the_four_kinds_and_mirrors() {
    let scene = made("showcase");
    let kinds: HashSet<SolidKind> = scene.primitives.iter().map(|primitive| primitive.solid.kind()).collect();
    assert_eq!(kinds.len(), 4);
    assert!(scene.primitives.iter().any(|primitive| primitive.material.specular > 0.5));
    assert_eq!(scene.camera.projection, Projection::Centered);
}

#[test]
fn figure_scenes_are_what_the_course_shows() {
    assert_eq!(made("corridor").max_depth, 5);
    assert_ne!(made("light").lights[0].intensity, DVec3::ONE);
    assert_eq!(made("several").primitives.len(), 3);
    assert_eq!(made("four").primitives.iter().map(|p| p.solid.kind()).collect::<Vec<_>>(), SolidKind::ALL);
    let start = made("start");
    assert!(start.primitives.is_empty());
    assert_eq!(start.camera.position, DVec3::new(0.0, 0.0, -2.0));
}

#[test]
fn families_have_a_valid_scene_of_any_number_up_to_a_million() {
    for name in ["squares-1", "squares-99", "cloud-1", "cloud-500", "cloud-cone-77", "cloud-cylinder-3"] {
        made(name).validate().unwrap_or_else(|error| panic!("{name}: {error}"));
        let count: usize = name.rsplit_once('-').unwrap().1.parse().unwrap();
        assert_eq!(made(name).primitives.len(), count, "{name}");
        assert!(gallery::has(name));
    }
    assert!(gallery::has("squares-1000000"));
    let refused =
        ["squares-0", "squares-1000001", "squares-", "squares-+7", "squares-007", "squares--7", "cloud-ball-7"];
    for name in refused.into_iter().chain(["cloud-cone-", "cloud--7", "squares-N", "squares-99999999999999999999"]) {
        assert!(!gallery::has(name) && gallery::scene(name).is_none(), "{name}");
    }
}

#[test]
fn squares_are_the_grid_of_table_4_1_where_that_is_one() {
    assert_eq!(made("squares-100"), made("grid-sphere-100"));
    let last = made("squares-1000").primitives[999].solid.position();
    assert_eq!(last, 2.0 * DVec3::new(31.0, 0.0, 7.0), "rows of 32");
}

#[test]
fn clouds_are_the_same_every_time_and_of_the_kinds_they_name() {
    let mixed = made("cloud-2000");
    assert_eq!(mixed, made("cloud-2000"));
    for kind in SolidKind::ALL {
        let of_kind = |scene: &Scene| scene.primitives.iter().filter(|p| p.solid.kind() == kind).count();
        assert!((400..600).contains(&of_kind(&mixed)), "{kind:?}");
        assert_eq!(of_kind(&made(&format!("cloud-{}-50", kind.name()))), 50);
    }
    let apart: HashSet<String> = mixed.primitives.iter().map(|p| format!("{:?}", p.solid.position())).collect();
    assert_eq!(apart.len(), 2000);
}
