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

    /// Another build of a shader of the program from the next chunk on; where the kernel is made from it, the picture
    /// is to be [asked for](Canvas::show) again.
    ///
    /// # Errors
    /// The device does not take it; the last build goes on.
    pub fn replace_shader(&mut self, build: Shader) -> Result<(), TracerError> {
        let own = self.renderer.shader();
        let is_used = own.name == build.name && self.builds.of(own).spirv() != build.spirv();
        let mut builds = self.builds.clone();
        builds.put(build);
        if is_used {
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
