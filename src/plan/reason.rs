//! Why a plan is as it is, in words.

use std::fmt;

use super::rounding::Cause;

/// Why something was decided; `Display` is one line of text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reason {
    /// It is the user's wish.
    Asked,
    /// The algorithm has no other.
    OnlyOne,
    /// Structures: the algorithm has no boxes around solids.
    NoHierarchy,
    /// Generations: nothing spares any of the scene's.
    SceneSays,
    /// Pixels per invocation: it traces several samples of one pixel instead.
    SamplesInstead,
    /// Lights and generations: the scene has no primitives.
    NoSolids,
    /// Box rotation: the kernel sees no box.
    NoBoxes,
    /// Every box stands along the world's axes.
    NoBoxRotated,
    /// Some boxes stand askew to the world's axes.
    BoxesRotated {
        /// All that the kernel sees.
        boxes: usize,
        /// Those among them that stand askew.
        rotated: usize,
    },
    /// Lights and light spheres: the scene has no light.
    NoLights,
    /// No primary ray meets the sphere of a light.
    LightSpheresOutOfSight {
        /// Number of lights in the scene.
        lights: usize,
    },
    /// Primary rays may meet spheres of lights.
    LightSpheresInSight {
        /// Number of lights in the scene.
        lights: usize,
        /// Those among them whose spheres may be met.
        seen: usize,
    },
    /// All are dark, or no surface sends anything back in their colours.
    NothingTakesLight {
        /// Number of lights in the scene.
        lights: usize,
    },
    /// Some light brightens some surface.
    LightsMatter {
        /// Number of lights in the scene.
        lights: usize,
        /// Those among them of intensity 0.
        dark: usize,
    },
    /// Shadows and highlights: no light brightens anything.
    NothingIsLit,
    /// Shadows: there is one solid, which is convex, and the camera is outside.
    LoneSolidShadowsNothing,
    /// Shadows: a solid may lie between a hit and a light.
    SolidsMayHide {
        /// Number of solids in the scene.
        solids: usize,
    },
    /// Highlights and generations: every material's specular is 0.
    NothingIsSpecular,
    /// Highlights: some material's specular is above 0.
    SomethingIsSpecular,
    /// Generations: some material's specular is above 0, but all rays end at the first hit.
    NothingReflects,
    /// Exponents: all highlights have the course work's.
    ExponentIsFive,
    /// Exponents: some highlight has another.
    OwnExponents,
    /// Attenuation: no light has a distance constant.
    NoLightFades,
    /// Attenuation: some lights fade with distance.
    LightsFade {
        /// Number of lights with a distance constant.
        lights: usize,
    },
    /// Ambient light: it is 1, or there is nothing that it falls on.
    AmbientLightIsWhite,
    /// Ambient light: it is not 1, and falls on something.
    AmbientLightIsColored,
    /// Refraction: every material's transmission is 0.
    NothingTransmits,
    /// Refraction: no solid that lets light through touches another or holds the camera.
    MediaLieApart {
        /// Number of solids that let light through.
        solids: usize,
    },
    /// Refraction: paths of one generation end where something would be refracted; only light passes.
    NothingIsRefracted,
    /// Refraction: what is outside of a solid may be another one.
    MediaMayTouch {
        /// Number of solids that let light through.
        solids: usize,
    },
    /// All highlights together.
    HighlightsAreFaint {
        /// The most that they add to a linear channel of a pixel.
        bound: f64,
    },
    /// Generations: no reflection can show anything but black.
    ReflectionsAreBlack,
    /// Generations: there is one solid, which shows itself and, mirrored, the background.
    LoneSolidMirrorsBackground,
    /// Generations: paths end where they weigh too little to matter.
    PathsFade {
        /// Weight at which a path ends; see [`Approximations`](super::Approximations::min_throughput).
        min_throughput: f32,
        /// Generations without an error.
        of: u32,
        /// The largest change of a linear channel by that.
        bound: f64,
    },
    /// No error is allowed, and all lengths are too near each other for rounding to show.
    RoundingIsNoCut {
        /// [`Precision::rounding_tolerance`](super::Precision::rounding_tolerance), times the brightest source above 1.
        tolerance: f64,
        /// The most that silhouettes move which the camera sees directly.
        shift_pixels: f64,
    },
    /// Of so many pixels that were tested no more than a stray one changes by more than `tolerance`.
    RoundingIsHarmless {
        /// Pixels all over the picture.
        tried: usize,
        /// Tolerance of a linear channel, as in [`Reason::RoundingIsNoCut`].
        tolerance: f64,
    },
    /// See [`Rounding::Harmful`](super::Rounding).
    RoundingSpoils {
        /// Those that were tested and change by more than the tolerance.
        wrong: usize,
        /// Pixels all over the picture.
        tried: usize,
        /// Put in words by its `Display`.
        cause: Cause,
    },
    /// See [`Rounding::Unknown`](super::Rounding).
    RoundingIsUnknown {
        /// How many times the smallest length the scene is.
        ratio: f64,
    },
    /// An error is allowed, and it is at least the tolerance.
    RoundingIsWithinError {
        /// As in [`Reason::RoundingIsNoCut`].
        tolerance: f64,
        /// As in [`Reason::RoundingIsNoCut`].
        shift_pixels: f64,
    },
    /// An error is allowed, and it is below the tolerance of `f32`.
    RoundingExceedsError {
        /// As in [`Reason::RoundingIsNoCut`].
        tolerance: f64,
    },
    /// An error is allowed, and silhouettes may move by more than half a pixel.
    RoundingMovesSilhouettes {
        /// As in [`Reason::RoundingIsNoCut`].
        shift_pixels: f64,
    },
    /// Though the allowed error asks for it.
    NoFloat64 {
        /// As in [`Reason::RoundingIsNoCut`].
        tolerance: f64,
        /// As in [`Reason::RoundingIsNoCut`].
        shift_pixels: f64,
    },
    /// Structures: every solid of every kind is looked at.
    FewSolids {
        /// Number of solids of the kind that has most.
        solids: usize,
        /// Most that are looked at one by one: [`Structure::BREAK_EVEN`].
        break_even: usize,
    },
    /// Structures: some kind has boxes around its solids.
    ManySolids {
        /// Number of solids of the kind that has most.
        solids: usize,
        /// Most that are looked at one by one: [`Structure::BREAK_EVEN`].
        break_even: usize,
    },
    /// Workgroup: it has one shape for all scenes.
    SquareWorkgroup,
    /// Pixels per invocation: one, for want of [`Limits::packets`](super::Limits::packets).
    NoPackets,
    /// Pixels per invocation: several, where there are packets.
    ManyPixelsPerInvocation,
    /// Pixels per invocation: one, since a CPU driver ends loops after so many iterations.
    LongPixels,
    /// Tiles: they are as large as they get.
    LightTiles,
    /// Tiles: larger ones could take a submission longer than a second or two.
    HeavyTiles {
        /// Side of a tile without that, pixels.
        largest: u32,
    },
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Asked => write!(f, "as asked for"),
            Self::OnlyOne => write!(f, "the algorithm has no other"),
            Self::NoHierarchy => write!(f, "the algorithm looks at every solid"),
            Self::SceneSays => write!(f, "as the scene says"),
            Self::NoSolids => write!(f, "there is no solid to be hit"),
            Self::NoBoxes => write!(f, "there are no boxes"),
            Self::NoBoxRotated => write!(f, "no box is rotated"),
            Self::BoxesRotated { boxes, rotated } => write!(f, "{rotated} of {boxes} boxes are rotated"),
            Self::NoLights => write!(f, "the scene has none"),
            Self::LightSpheresOutOfSight { lights } => write!(f, "the picture shows none of {lights}"),
            Self::LightSpheresInSight { lights, seen } => write!(f, "the picture may show {seen} of {lights}"),
            Self::NothingTakesLight { lights } => {
                write!(f, "{lights} in the scene, but no surface sends back anything of their light")
            }
            Self::LightsMatter { lights, dark: 0 } => write!(f, "{lights} in the scene"),
            Self::LightsMatter { lights, dark } => write!(f, "{lights} in the scene, of which {dark} brighten nothing"),
            Self::NothingIsLit => write!(f, "nothing is lit"),
            Self::SamplesInstead => write!(f, "an invocation traces several samples of a pixel, one after another"),
            Self::LoneSolidShadowsNothing => {
                write!(f, "one convex solid, seen from outside, casts no shadow on itself but where it turns away")
            }
            Self::SolidsMayHide { solids } => write!(f, "{solids} solid(s) may lie between a hit and a light"),
            Self::NothingIsSpecular => write!(f, "no material is specular"),
            Self::SomethingIsSpecular => write!(f, "some material is specular"),
            Self::NothingReflects => write!(f, "no material mirrors or lets light through"),
            Self::ExponentIsFive => write!(f, "all highlights have the exponent 5"),
            Self::OwnExponents => write!(f, "some highlight has an exponent other than 5"),
            Self::NoLightFades => write!(f, "no light has a distance_constant"),
            Self::LightsFade { lights } => write!(f, "{lights} light(s) have a distance_constant"),
            Self::AmbientLightIsWhite => write!(f, "it is white, of intensity 1"),
            Self::AmbientLightIsColored => write!(f, "it is not white of intensity 1"),
            Self::NothingTransmits => write!(f, "no material lets light through"),
            Self::MediaLieApart { solids } => {
                write!(f, "{solids} solid(s) let light through, and touch neither another nor the camera")
            }
            Self::NothingIsRefracted => {
                write!(f, "paths of one generation refract nothing: only what comes from lights passes")
            }
            Self::MediaMayTouch { solids } => {
                write!(f, "{solids} solid(s) let light through, and may touch another or hold the camera")
            }
            Self::HighlightsAreFaint { bound } => {
                write!(f, "all highlights of a pixel add at most {} to a channel", Short(bound))
            }
            Self::ReflectionsAreBlack => write!(f, "all that could be mirrored is black"),
            Self::LoneSolidMirrorsBackground => {
                write!(f, "one convex solid, seen from outside, mirrors nothing but the background")
            }
            Self::PathsFade { min_throughput, of, bound } => write!(
                f,
                "of {of}: a path ends at a weight of {}, and what it leaves out is at most {}",
                Short(min_throughput.into()),
                Short(bound)
            ),
            Self::RoundingIsNoCut { tolerance, shift_pixels } => write!(
                f,
                "nothing is cut by rounding: channels keep within {} off edges (tested), silhouettes seen \
                 directly within {} pixels",
                Short(tolerance),
                Short(shift_pixels)
            ),
            Self::RoundingIsHarmless { tried, tolerance } => write!(
                f,
                "of {tried} pixels that were tried, rounding to f32 changes a channel of none or a stray one by more \
                 than {}",
                Short(tolerance)
            ),
            Self::RoundingSpoils { wrong, tried, cause } => {
                write!(f, "rounding to f32 spoils {wrong} of {tried} pixels that were tried: {cause}")
            }
            Self::RoundingIsUnknown { ratio } => write!(
                f,
                "lengths differ by {}, and what rounding to f32 does to so many solids would take too long to try",
                Short(ratio)
            ),
            Self::RoundingIsWithinError { tolerance, shift_pixels } => write!(
                f,
                "rounding to f32 keeps channels within {} off edges (tested; not part of the bound), silhouettes \
                 seen directly within {} pixels",
                Short(tolerance),
                Short(shift_pixels)
            ),
            Self::RoundingExceedsError { tolerance } => {
                write!(
                    f,
                    "rounding to f32 alone is only known to keep channels within {}, more than is allowed",
                    Short(tolerance)
                )
            }
            Self::RoundingMovesSilhouettes { shift_pixels } => {
                write!(f, "rounding to f32 may move silhouettes by {} pixels", Short(shift_pixels))
            }
            Self::NoFloat64 { tolerance, shift_pixels } => write!(
                f,
                "the device has no f64: rounding may change channels by {} and move silhouettes by {} pixels",
                Short(tolerance),
                Short(shift_pixels)
            ),
            Self::FewSolids { solids, break_even } => {
                write!(f, "{solids} solid(s) of a kind at most, and up to {break_even} are looked at one by one")
            }
            Self::ManySolids { solids, break_even } => {
                write!(f, "{solids} solids of a kind, more than the {break_even} that are looked at one by one")
            }
            Self::SquareWorkgroup => write!(f, "as many pixels as a wave has lanes, near each other"),
            Self::NoPackets => write!(f, "invocations do not come in packets that go together"),
            Self::ManyPixelsPerInvocation => write!(f, "a packet of rays that have ended goes on to its next pixels"),
            Self::LongPixels => write!(f, "a pixel may take long by itself"),
            Self::LightTiles => write!(f, "one submission can trace that much within a second or two"),
            Self::HeavyTiles { largest } => {
                write!(
                    f,
                    "in place of {largest}: a submission of heavier rays must not take longer than a second or two"
                )
            }
        }
    }
}

/// A number to four digits, bounds and the like: always rounded up.
pub(super) struct Short(pub f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        if value == 0.0 {
            return write!(f, "0");
        }
        let unit = 10f64.powi(value.abs().log10().floor() as i32 - 3);
        let rounded = (value / unit).ceil() * unit;
        if (1e-3..1e6).contains(&rounded) { write!(f, "{rounded:.6}") } else { write!(f, "{rounded:.3e}") }
    }
}
