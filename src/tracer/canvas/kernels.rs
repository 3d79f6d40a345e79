//! Which kernel a [`Canvas`] traces by, and from which build.

use super::super::renderer::{MadeFor, renderer};
use super::super::{Kernel, TracerError};
use super::Canvas;
use crate::gpu::{Builds, Shader};
use crate::settings::sampling::most_samples;

impl Canvas {
    /// A kernel from the next chunk on; returns whether it is another one; then the picture is to be
    /// [asked for](Canvas::show) again. A pixel has no more samples than it can take.
    pub fn use_kernel(&mut self, kernel: Kernel) -> Result<bool, TracerError> {
        if kernel == self.renderer.kernel() {
            return Ok(false);
        }
        self.renderer = renderer(&self.device, kernel, &self.builds, MadeFor::Live)?;
        self.dropped.extend(self.pixels.take());
        self.sampling.samples = self.sampling.samples.min(most_samples(kernel.description()));
        self.begin_anew();
        Ok(true)
    }

    /// Other builds of shaders of the program from the next chunk on; where the kernel is made from one, the picture is
    /// to be [asked for](Canvas::show) again.
    ///
    /// # Errors
    /// The device does not take them; the last builds go on.
    pub fn replace_shaders(&mut self, changed: impl IntoIterator<Item = Shader>) -> Result<(), TracerError> {
        let mut builds = self.builds.clone();
        changed.into_iter().for_each(|build| builds.put(build));
        let differs = |own: &&Shader| self.builds.of(own).spirv() != builds.of(own).spirv();
        if self.renderer.shaders().iter().any(differs) {
            self.renderer.rebuild(&builds)?;
            self.begin_anew();
        }
        self.builds = builds;
        Ok(())
    }

    /// What kernels are made from, in place of the program's own.
    pub fn builds(&self) -> &Builds {
        &self.builds
    }
}
