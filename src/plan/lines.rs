//! A plan in lines of text.

use std::fmt;

use serde::Serialize;

use super::reason::Short;
use super::{Decision, Plan, Reason, Structure};
use crate::algorithm::Algorithm;
use crate::scene::SolidKind;

/// A decision as people read it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Line {
    /// What it is about.
    pub what: &'static str,
    /// What was decided, in words or a number.
    pub choice: String,
    /// The [`Reason`], or another line of text.
    pub why: String,
    /// What is left out of the kernel or of its work.
    pub saves: Option<String>,
}

impl Line {
    pub(super) fn new<T>(
        what: &'static str,
        choice: impl fmt::Display,
        decision: &Decision<T>,
        saves: Option<&str>,
    ) -> Self {
        let (choice, why) = (choice.to_string(), decision.reason.to_string());
        Self { what, choice, why, saves: saves.map(str::to_owned) }
    }
}

impl Plan {
    /// Every decision, in the order in which a ray meets them.
    pub fn lines(&self) -> Vec<Line> {
        let mut lines: Vec<Line> = SolidKind::ALL.into_iter().map(|kind| self.kind_line(kind)).collect();
        lines.push(self.axis_aligned_line());
        lines.push(Line::new("structure", structures(&self.structures.choice), &self.structures, None));
        lines.extend([self.light_spheres_line(), self.lights_line(), self.shadows_line(), self.highlights_line()]);
        lines.extend(self.light_model.lines());
        lines.push(self.generations_line());
        lines.extend(self.screen_space_line());
        lines.push(Line::new("precision", self.precision.choice.name(), &self.precision, None));
        lines.extend(self.close_up_line());
        let [width, height] = self.workgroup.choice;
        lines.push(Line::new("workgroup", format!("{width}x{height}"), &self.workgroup, None));
        lines.push(Line::new("pixels per invocation", self.pixels.choice, &self.pixels, None));
        lines.push(self.tiles_line());
        lines.extend(self.shadow_cut_line());
        lines.push(self.error_line());
        lines
    }

    fn kind_line(&self, kind: SolidKind) -> Line {
        let count = self.counts[kind as usize];
        let (what, search) = match kind {
            SolidKind::Sphere => ("spheres", "the search through spheres"),
            SolidKind::Box => ("boxes", "the search through boxes"),
            SolidKind::Cylinder => ("cylinders", "the search through cylinders"),
            SolidKind::Cone => ("cones", "the search through cones"),
        };
        let why = if count == 0 { "the scene has none" } else { "in the scene" }.to_owned();
        Line { what, choice: none_or(count), why, saves: (count == 0).then(|| search.to_owned()) }
    }

    fn axis_aligned_line(&self) -> Line {
        let has_boxes = self.counts[SolidKind::Box as usize] > 0;
        let saves = (self.axis_aligned_boxes.choice && has_boxes).then_some("the rotation of every ray into every box");
        let choice = if self.axis_aligned_boxes.choice { "none" } else { "yes" };
        Line::new("rotated boxes", choice, &self.axis_aligned_boxes, saves)
    }

    fn light_spheres_line(&self) -> Line {
        let saves = (self.light_spheres.choice == 0).then_some("the sphere of every light for every primary ray");
        Line::new("light spheres", none_or(self.light_spheres.choice), &self.light_spheres, saves)
    }

    fn lights_line(&self) -> Line {
        let saves = match self.lights.choice {
            0 => Some("all shading by lights"),
            1 => Some("the loop over lights"),
            _ if self.shadows.choice && self.features().lights == 3 => {
                Some("a shadow ray to each: every hit's goes to one of them, by what it may give")
            }
            _ => None,
        };
        Line::new("lights", none_or(self.lights.choice), &self.lights, saves)
    }

    fn shadows_line(&self) -> Line {
        let saves = (!self.shadows.choice).then_some("a shadow ray for every light at every hit");
        Line::new("shadow rays", yes_or_none(self.shadows.choice), &self.shadows, saves)
    }

    fn highlights_line(&self) -> Line {
        let saves = (!self.highlights.choice).then_some("a mirrored direction for every light at every hit");
        Line::new("highlights", yes_or_none(self.highlights.choice), &self.highlights, saves)
    }

    fn generations_line(&self) -> Line {
        let generations = self.generations.choice;
        let saves = match self.generations.reason {
            Reason::PathsFade { of, .. } if generations < of => Some(format!(
                "the last {} generations of every path, and more of those that fade faster",
                of - generations
            )),
            Reason::PathsFade { .. } => Some("the ends of paths that fade faster".to_owned()),
            _ if generations == 1 => Some("all reflections".to_owned()),
            _ => None,
        };
        Line::new("generations", generations, &self.generations, saves.as_deref())
    }

    /// What an algorithm leaves out of the light model whatever the scene.
    pub fn screen_space_line(&self) -> Option<Line> {
        (self.settings.algorithm == Algorithm::Ssr).then(|| Line {
            what: "mirrored rays",
            choice: "on screen".to_owned(),
            why: "they find only what the camera sees, else the background; refracted rays are left out".to_owned(),
            saves: Some("the search for what mirrored rays meet, and its shadow rays".to_owned()),
        })
    }

    fn tiles_line(&self) -> Line {
        let side = self.tile_side.choice;
        match self.kernel.draws_whole() {
            true => Line {
                what: "tiles",
                choice: "none".to_owned(),
                why: "the picture is drawn whole".to_owned(),
                saves: None,
            },
            false => Line::new("tiles", format!("{side}x{side}"), &self.tile_side, None),
        }
    }

    fn close_up_line(&self) -> Option<Line> {
        self.close_up.map(|ratio| Line {
            what: "close-up",
            choice: "yes".to_owned(),
            why: format!(
                "lengths differ by {}: solids are told from where they are nearest to the camera",
                Short(ratio)
            ),
            saves: None,
        })
    }

    fn shadow_cut_line(&self) -> Option<Line> {
        let least = self.approximations.min_shadowed;
        (least > 0.0).then(|| Line {
            what: "faint shadows",
            choice: "left out".to_owned(),
            why: format!(
                "half of any light below {} counts without a shadow ray, at most {} off in all",
                Short(least.into()),
                Short(self.bounds.shadows)
            ),
            saves: Some("the shadow rays of faint light".to_owned()),
        })
    }

    fn error_line(&self) -> Line {
        let (error, bounds) = (self.settings.error, &self.bounds);
        let unbounded = match self.settings.algorithm {
            Algorithm::Ssr => Some(("unknown", "how far reflections are off is bounded by nothing")),
            Algorithm::Path => Some(("by chance", "the picture comes with an estimate of its standard error")),
            Algorithm::Course | Algorithm::Plain | Algorithm::Whitted | Algorithm::Reference => None,
        };
        if let Some((choice, why)) = unbounded {
            return Line { what: "error", choice: choice.to_owned(), why: why.to_owned(), saves: None };
        }
        let why = if bounds.total() == 0.0 {
            "nothing is left out that a pixel could show".to_owned()
        } else {
            format!(
                "the bound relied on: highlights {} + generations {} + shadows {}, of {} allowed",
                Short(bounds.highlights),
                Short(bounds.generations),
                Short(bounds.shadows),
                Short(error)
            )
        };
        Line { what: "error", choice: Short(bounds.total()).to_string(), why, saves: None }
    }
}

/// The kinds that have one, with the levels of it.
fn structures(structures: &[Structure; 4]) -> String {
    let level = |(kind, structure): (SolidKind, &Structure)| match structure {
        Structure::None => None,
        Structure::Hierarchy { levels } => Some(format!("{} {levels} level(s)", kind.name())),
    };
    let levels: Vec<_> = SolidKind::ALL.into_iter().zip(structures).filter_map(level).collect();
    if levels.is_empty() { "none".to_owned() } else { format!("hierarchy: {}", levels.join(", ")) }
}

fn none_or(count: usize) -> String {
    if count == 0 { "none".to_owned() } else { count.to_string() }
}

fn yes_or_none(is: bool) -> &'static str {
    if is { "yes" } else { "none" }
}
