//! Cases that no kernel should ever see: scenes that are refused, by name, when they are loaded.

use super::{Case, Measured};
use crate::scene::{Scene, Solid};

/// A primitive's fields in TOML, and the field that the refusal names; `None` where it is not refused.
type Entry = (&'static str, Option<&'static str>);

const ENTRIES: [&[Entry]; 12] = [
    &[("kind = 'sphere'\nradius = 0", Some("radius")), ("kind = 'sphere'\nradius = -1", Some("radius"))],
    &[("kind = 'cylinder'\nends = [[1, 2, 3], [1, 2, 3]]", Some("ends"))],
    &[("kind = 'box'\nhalf_size = [1, -1, 1]", Some("half_size"))],
    // Made of length 1, not refused.
    &[("kind = 'cone'\naxis = [0, -3, 0]", None)],
    &[("kind = 'cone'\naxis = [0, 0, 0]", Some("axis"))],
    &[
        ("kind = 'cone'\nhalf_angle_degrees = 0", Some("half_angle_degrees")),
        ("kind = 'cone'\nhalf_angle_degrees = -5", Some("half_angle_degrees")),
    ],
    &[
        ("kind = 'cone'\nhalf_angle_degrees = 90", Some("half_angle_degrees")),
        ("kind = 'cone'\nhalf_angle_degrees = 120", Some("half_angle_degrees")),
    ],
    &[("kind = 'cone'\nheight = 0", Some("height")), ("kind = 'cone'\nheight = -2", Some("height"))],
    &[("kind = 'sphere'\nradius = nan", Some("radius")), ("kind = 'box'\ncenter = [0, nan, 0]", Some("center"))],
    &[("kind = 'sphere'\nradius = inf", Some("radius")), ("kind = 'cone'\napex = [inf, 0, 0]", Some("apex"))],
    &[("kind = 'sphere'\ncenter = [0, 0, -inf]", Some("center"))],
    &[("kind = 'sphere'\nradius = 1e-310", None), ("kind = 'sphere'\ncenter = [1e-320, 0, 0]", None)],
];

pub(super) fn cases() -> Vec<Case> {
    let case = |(index, entries): (usize, &'static [Entry])| {
        Case::of_loader(format!("DG-{}", index + 1), move || {
            let wrong = entries.iter().filter(|entry| !is_right(entry)).count();
            vec![Measured::none_of("scenes accepted, refused or named wrongly", wrong)]
        })
    };
    ENTRIES.into_iter().enumerate().map(case).collect()
}

fn is_right(&(fields, refused): &Entry) -> bool {
    let loaded = Scene::from_toml(&format!("[[primitives]]\n{fields}\n"));
    match (loaded, refused) {
        (Ok(scene), None) => scene.primitives.iter().all(|primitive| match primitive.solid {
            Solid::Cone { axis, .. } => (axis.length() - 1.0).abs() < 1e-15,
            _ => true,
        }),
        (Err(error), Some(field)) => error.is_input_error() && error.to_string().contains(field),
        _ => false,
    }
}
