//! A scene as the accurate kernel, `glsl/whitted.comp`, takes it.

use std::sync::Arc;

use glam::DVec3;

use super::super::{Kernel, Settings, TracerError};
use super::records::{WhittedPushConstants, WhittedRecords};
use crate::gpu::{BindingKind, Buffer, BufferKind, Device, GpuError, Resource, Texel};
use crate::plan::{Area, Features, MOST_PIXELS, Precision};
use crate::scene::Scene;

impl Precision {
    /// A vector and its error as the nearest vector of this precision and what is missing.
    pub(super) fn split(self, (vector, error): (DVec3, DVec3)) -> (DVec3, DVec3) {
        match self {
            Self::F32 => {
                let nearest = vector.as_vec3().as_dvec3();
                (nearest, (vector - nearest) + error)
            }
            Self::F64 => (vector, error),
        }
    }

    /// Bytes of a row of four numbers.
    pub(super) fn row_bytes(self) -> u64 {
        match self {
            Self::F32 => 16,
            Self::F64 => 32,
        }
    }

    /// How the kernel reads rows.
    pub(super) fn texel(self) -> Texel {
        match self {
            Self::F32 => Texel::Floats,
            Self::F64 => Texel::Bits,
        }
    }

    /// Numbers as the kernel reads them.
    pub(in crate::tracer) fn bytes(self, numbers: &[f64]) -> Vec<u8> {
        match self {
            Self::F32 => numbers.iter().flat_map(|&number| (number as f32).to_ne_bytes()).collect(),
            Self::F64 => bytemuck::cast_slice(numbers).to_vec(),
        }
    }
}

/// Bindings 1 to 7 of `glsl/records/scene.glsl`.
pub fn scene_bindings(precision: Precision) -> [BindingKind; 7] {
    let mut bindings = [BindingKind::Texels(precision.texel()); 7];
    bindings[1] = BindingKind::Texels(Texel::Floats);
    bindings
}

/// Refuses a precision that the device does not have.
pub fn check_precision(device: &Device, precision: Precision) -> Result<(), TracerError> {
    let description = device.description();
    if precision == Precision::F64 && !description.float64 {
        return Err(TracerError::Refused(format!(
            "device '{}' cannot calculate in f64 (it lacks shaderFloat64); --precision f32 works there",
            description.name
        )));
    }
    Ok(())
}

/// Refuses arrays larger than the device lets a kernel see.
fn check_size(device: &Device, records: &WhittedRecords, precision: Precision) -> Result<(), TracerError> {
    let proxies = ("proxies", records.solids.proxies.len() as u64 * Texel::BYTES);
    let own = records.buffers().map(|(name, rows)| (name, rows.len() as u64 * precision.row_bytes()));
    let description = device.description();
    let limit = description.max_texels * Texel::BYTES;
    let mut arrays = own.into_iter().chain([proxies]);
    arrays.try_for_each(|(name, bytes)| check_array(name, bytes, &description.name, limit))
}

fn check_array(name: &str, bytes: u64, device: &str, limit: u64) -> Result<(), TracerError> {
    if bytes > limit {
        return Err(TracerError::Refused(format!(
            "the scene is too large for device '{device}': its {name} take {bytes} B, and a kernel sees {limit} B there"
        )));
    }
    Ok(())
}

/// The scene's buffers, in the order of their bindings.
///
/// # Errors
/// An array larger than the device lets a kernel see.
pub fn upload_scene(
    device: &Arc<Device>,
    records: &WhittedRecords,
    precision: Precision,
) -> Result<Vec<Resource>, TracerError> {
    check_size(device, records, precision)?;
    Ok(upload(device, records, precision)?)
}

fn upload(device: &Arc<Device>, records: &WhittedRecords, precision: Precision) -> Result<Vec<Resource>, GpuError> {
    let upload = |name: &str, texel: Texel, bytes: &[u8]| {
        // An array of none still has to be bound: as one record of zeros, which no count reaches.
        let size = (bytes.len() as u64).max(EMPTY_ARRAY_BYTES);
        let mut buffer = Buffer::new(device, name, BufferKind::Texels(texel), size)?;
        buffer.write(bytes)?;
        Ok(Resource::from(&Arc::new(buffer)))
    };
    let mut resources = Vec::new();
    for (name, rows) in records.buffers() {
        resources.push(upload(name, precision.texel(), &precision.bytes(rows.as_flattened()))?);
    }
    resources.insert(1, upload("proxies", Texel::Floats, bytemuck::cast_slice(&records.solids.proxies))?);
    Ok(resources)
}

/// The largest record: seven rows of four doubles.
const EMPTY_ARRAY_BYTES: u64 = 7 * 32;

/// What a kernel knows of a picture, besides the scene's arrays.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct ViewUniforms {
    pub frame: WhittedPushConstants,
    /// Where light spheres may be seen.
    pub light_spheres: Option<Area>,
}

/// Where a picture shows light spheres.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LightSpheres {
    Nowhere,
    Somewhere,
    Everywhere,
}

impl ViewUniforms {
    pub fn where_light_spheres_are(&self) -> LightSpheres {
        let [width, height] = unpacked(self.frame.image_size);
        match self.light_spheres.map(|area| area.pixels([width, height])) {
            None => LightSpheres::Nowhere,
            Some(pixels) if pixels == [0..width, 0..height] => LightSpheres::Everywhere,
            Some(_) => LightSpheres::Somewhere,
        }
    }
}

/// Two numbers below 2¹⁶.
pub(super) fn unpacked(packed: u32) -> [u32; 2] {
    [packed & 0xFFFF, packed >> 16]
}

/// A scene as the kernel takes it.
#[derive(PartialEq)]
pub(super) struct WhittedScene {
    pub kernel: Kernel,
    pub records: WhittedRecords,
    pub features: Features,
    /// Uniforms of the whole picture in one tile.
    pub view_uniforms: ViewUniforms,
    pub workgroup: [u32; 2],
    /// Samples of each pixel.
    pub samples: u32,
    /// Linear RGB.
    pub background: [f32; 3],
}

impl WhittedScene {
    /// With the scene's records for a picture of the settings' size, and so many pixels an invocation, where those come
    /// in packets.
    ///
    /// # Errors
    /// The device lets no kernel see so many primitives.
    pub fn new(
        device: &Device,
        scene: &Scene,
        records: WhittedRecords,
        settings: &Settings,
        pixels: u32,
    ) -> Result<Self, TracerError> {
        let &Settings { width, height, kernel, approximations, samples, workgroup, .. } = settings;
        check_size(device, &records, kernel.precision())?;
        let generations = settings.generations(scene);
        // What the window shows stays the same to the last bit at any scale.
        let [traced_width, traced_height] = settings.sampling().traced_size([width, height]);
        let traced_size = traced_width | traced_height << 16;
        let frame = WhittedPushConstants {
            counts: records.solids.counts,
            first_proxies: records.solids.first_proxies,
            tile_origin: 0,
            image_size: traced_size,
            depth: generations,
            light_count: records.light_count,
            reach: records.solids.frame.reach,
            writes_remainder: 0,
            min_throughput: approximations.min_throughput,
            min_shadowed: approximations.min_shadowed,
            sample_place: [0, 0],
            samples_before: 0,
            sample_weight: 1.0,
            tile_size: traced_size,
            light_sphere_count: records.light_sphere_count,
            seed: settings.seed,
            samples_at_once: 1,
            padding: [0; 2],
        };
        let exact = Features::of(&records, kernel.description(), &approximations, generations);
        let levels = if settings.without_boxes { [0; 4] } else { exact.levels };
        let features = Features {
            levels,
            samples: samples > 1,
            pixels: pixels.clamp(1, MOST_PIXELS),
            independent_numbers: settings.independent_numbers,
            ..exact
        };
        let background = scene.background.as_vec3().to_array();
        // No coordinate is larger than twice the reach: no two points are farther apart than 4 * sqrt(3) of that.
        let farthest = 7.0 * f64::from(records.solids.frame.reach) / records.solids.frame.scale;
        let light_spheres = Area::of_light_spheres(scene, f64::from(width) / f64::from(height), farthest);
        let view_uniforms =
            ViewUniforms { frame, light_spheres: light_spheres.filter(|_| approximations.light_spheres) };
        Ok(Self { kernel, records, features, view_uniforms, workgroup, samples, background })
    }

    pub fn upload(&self, device: &Arc<Device>) -> Result<Vec<Resource>, GpuError> {
        upload(device, &self.records, self.kernel.precision())
    }

    /// Bytes of all arrays.
    pub fn bytes(&self) -> u64 {
        let rows: usize = self.records.buffers().iter().map(|(_, rows)| rows.len()).sum();
        rows as u64 * self.kernel.precision().row_bytes() + self.records.solids.proxies.len() as u64 * Texel::BYTES
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_larger_than_a_device_shows_a_kernel_are_refused_in_one_line() {
        assert!(check_array("spheres", 4096, "small", 4096).is_ok());
        let error = check_array("spheres", 4112, "small", 4096).unwrap_err();
        assert!(error.is_input_error());
        let line = error.to_string();
        assert!(!line.contains('\n'), "{line}");
        for part in ["too large", "'small'", "spheres", "4112 B", "4096 B"] {
            assert!(line.contains(part), "{part} is missing in: {line}");
        }
    }
}
