//! The catalogue of extremes (NUMERICS.md): what each kernel makes of every case, in units a bar is stated in.

mod pictures;
mod rays;

use std::sync::Arc;

use crate::gpu::Device;
use crate::tracer::{Kernel, TracerError};

/// One thing measured of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// What, by the letters of NUMERICS.md («T», «P», «N», «H») or in words.
    pub what: &'static str,
    pub measured: f64,
    /// Passed where `measured` is at most this.
    pub bound: f64,
}

impl Measured {
    /// A NaN passes no bound.
    pub fn passes(&self) -> bool {
        self.measured <= self.bound
    }
}

/// An entry of the catalogue, such as `DS-3`.
pub struct Case {
    pub id: String,
    /// Tries a kernel on it. `quick`: with so few rays and pixels that the whole catalogue takes a minute.
    pub run: Box<dyn Fn(&Arc<Device>, Kernel, bool) -> Result<Vec<Measured>, TracerError> + Send + Sync>,
}

/// Every entry, in the catalogue's order.
pub fn catalogue() -> Vec<Case> {
    rays::cases().into_iter().chain(pictures::cases()).collect()
}
