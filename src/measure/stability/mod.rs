//! The catalogue of extremes (docs/numerics.md): what each kernel makes of every case, in units that a tolerance is
//! stated in.

mod finite;
mod glass;
mod judge;
mod loading;
mod pictures;
mod rays;
mod reported;
mod scenes;
mod sheet;
mod solids;
mod tables;
mod trials;

pub use judge::distance;
pub use sheet::error_sheet;
pub(crate) use tables::{summary, trials};
pub use trials::Row;
pub(crate) use trials::try_all;

use std::cell::RefCell;
use std::sync::{Arc, OnceLock};

use crate::algorithm::Description;
use crate::gpu::Device;
use crate::tracer::probe::Probe;
use crate::tracer::{Kernel, Tracer, TracerError};

/// One thing measured of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// What, in words.
    pub what: &'static str,
    /// In the unit of `what`; a NaN passes no bound.
    pub measured: f64,
    /// Passed where `measured` is at most this.
    pub bound: f64,
}

impl Measured {
    /// Nothing of the kind may be found.
    fn none_of(what: &'static str, found: usize) -> Self {
        Self { what, measured: found as f64, bound: 0.0 }
    }

    /// A NaN passes no bound.
    pub fn passes(&self) -> bool {
        self.measured <= self.bound
    }

    /// How near to its bound it comes, or how far beyond: 1 is the bound.
    fn share(&self) -> f64 {
        match (self.measured, self.bound) {
            (measured, _) if measured.is_nan() => f64::INFINITY,
            (0.0, 0.0) => 0.0,
            (measured, bound) => measured / bound,
        }
    }
}

/// A kernel to be tested on a device.
pub struct Subject {
    /// Where the kernel runs.
    pub device: Arc<Device>,
    /// Algorithm and precision.
    pub kernel: Kernel,
    /// With so few rays and pixels that the whole catalogue takes a minute.
    pub is_quick: bool,
    probe: OnceLock<Probe>,
    /// Tracer of the last picture, with its size: cases in a row often need the same pipeline, which takes longer to
    /// make than a picture to draw.
    tracer: RefCell<Option<([u32; 2], Tracer)>>,
}

impl Subject {
    /// A kernel on a device, with neither a probe nor a tracer made yet.
    pub fn new(device: &Arc<Device>, kernel: Kernel, is_quick: bool) -> Self {
        Self { device: device.clone(), kernel, is_quick, probe: OnceLock::new(), tracer: RefCell::default() }
    }

    fn probe(&self) -> Result<&Probe, TracerError> {
        if let Some(probe) = self.probe.get() {
            return Ok(probe);
        }
        let probe = Probe::new(&self.device, self.kernel)?;
        Ok(self.probe.get_or_init(|| probe))
    }
}

type Trial = Box<dyn Fn(&Subject) -> Result<Vec<Measured>, TracerError>>;
type SceneTrial = Box<dyn Fn() -> Vec<Measured>>;

/// How a case is tested.
enum Try {
    /// On a kernel; nothing measured: it is not for that kernel.
    Kernel(Trial),
    /// On the scene's loader, before any kernel.
    Loader(SceneTrial),
}

/// An entry of the catalogue.
pub struct Case {
    /// Such as `DS-3`.
    pub id: String,
    trial: Try,
    /// Which algorithms it is for.
    is_for: fn(&Description) -> bool,
}

impl Case {
    fn of_kernel(
        id: impl Into<String>,
        trial: impl Fn(&Subject) -> Result<Vec<Measured>, TracerError> + 'static,
    ) -> Self {
        Self { id: id.into(), trial: Try::Kernel(Box::new(trial)), is_for: Description::casts_rays }
    }

    /// Also for those whose pictures are not of single rays, or depend on chance.
    fn for_every_algorithm(self) -> Self {
        Self { is_for: Description::is_on_device, ..self }
    }

    /// Also for those whose pictures depend on chance.
    fn for_chance_too(self) -> Self {
        Self { is_for: |row| row.casts_rays() || row.is_statistical, ..self }
    }

    fn of_loader(id: impl Into<String>, trial: impl Fn() -> Vec<Measured> + 'static) -> Self {
        Self { id: id.into(), trial: Try::Loader(Box::new(trial)), is_for: |_| false }
    }

    /// Letters before the number: cases of one kind.
    pub fn group(&self) -> &str {
        self.id.split('-').next().unwrap_or(&self.id)
    }

    /// Whether it is about the scene's loader, whatever the kernel.
    pub fn is_of_loader(&self) -> bool {
        matches!(self.trial, Try::Loader(_))
    }

    /// `None` where the case is not for this kernel, or is not about kernels.
    pub fn try_kernel(&self, subject: &Subject) -> Result<Option<Verdict>, TracerError> {
        match &self.trial {
            Try::Kernel(trial) if (self.is_for)(subject.kernel.description()) => Ok(Verdict::of(trial(subject)?)),
            Try::Kernel(_) | Try::Loader(_) => Ok(None),
        }
    }

    /// `None` where the case is about kernels.
    pub fn try_loader(&self) -> Option<Verdict> {
        match &self.trial {
            Try::Kernel(_) => None,
            Try::Loader(trial) => Verdict::of(trial()),
        }
    }
}

/// What came of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Everything measured of the case; never empty.
    pub measured: Vec<Measured>,
    /// Measurement nearest to its bound or farthest beyond.
    pub worst: Measured,
}

impl Verdict {
    fn of(measured: Vec<Measured>) -> Option<Self> {
        // Of several as good, the first.
        let worst = *measured.iter().rev().max_by(|a, b| a.share().total_cmp(&b.share()))?;
        Some(Self { measured, worst })
    }

    /// Whether every measurement is within its bound.
    pub fn passes(&self) -> bool {
        self.measured.iter().all(Measured::passes)
    }
}

/// Every entry, in the catalogue's order.
pub fn catalogue() -> Vec<Case> {
    rays::cases()
        .into_iter()
        .chain(loading::cases())
        .chain(pictures::cases())
        .chain(glass::cases())
        .chain(reported::cases())
        .chain(finite::cases())
        .collect()
}
