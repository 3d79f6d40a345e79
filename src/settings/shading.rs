use std::borrow::Cow;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::scene::Scene;

/// How much of the light model is drawn: the models of the course work's figures 1.2 and 1.3, and the whole of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Shading {
    /// Ambient and diffuse light with shadows: equations 1.15 and 1.16
    Lambert,
    /// Lambert's, and highlights: equation 1.18
    Phong,
    /// Phong's, and mirrored and refracted rays: equation 1.19
    #[default]
    Whitted,
}

impl Shading {
    /// On the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lambert => "lambert",
            Self::Phong => "phong",
            Self::Whitted => "whitted",
        }
    }

    /// The scene whose whole model is what this model draws of `scene`: what it lacks is in no material, so that plans
    /// leave it out of kernels.
    pub fn applied(self, scene: &Scene) -> Cow<'_, Scene> {
        if self == Self::Whitted {
            return Cow::Borrowed(scene);
        }
        let mut scene = scene.clone();
        for primitive in &mut scene.primitives {
            let material = &mut primitive.material;
            material.reflection = Some(0.0);
            material.transmission = 0.0;
            if self == Self::Lambert {
                material.specular = 0.0;
            }
        }
        Cow::Owned(scene)
    }
}
