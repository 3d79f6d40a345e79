//! Host and kernels mean the same bytes: every field of every record is given its own value and comes back from a
//! kernel that reads it by name.

use std::sync::Arc;

use crate::common::TestDevice;
use bytemuck::{Pod, bytes_of, cast_slice};
use zerkalo::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, Commands, ComputePipeline, PipelineDescription, Resource,
    StorageImage, Use, shaders,
};
use zerkalo::tracer::course::{
    BINDINGS, BoxRecord, ConeRecord, CoursePushConstants, CylinderRecord, LightRecord, MAX_PRIMITIVES, MaterialRecord,
    PrimitiveRecords, SphereRecord, upload,
};

/// Hands out 1, 2, 3, … and remembers them in the order in which the kernel will echo them.
#[derive(Default)]
struct Values {
    given: Vec<f32>,
}

impl Values {
    fn one(&mut self) -> f32 {
        self.given.push(self.given.len() as f32 + 1.0);
        self.given.len() as f32
    }

    fn three(&mut self) -> [f32; 3] {
        [self.one(), self.one(), self.one()]
    }

    fn material(&mut self) -> MaterialRecord {
        MaterialRecord { color: self.three(), coefficients: self.three(), ..filled() }
    }

    fn records(&mut self) -> PrimitiveRecords {
        let spheres = self.each(|v| SphereRecord { center: v.three(), radius: v.one(), material: v.material() });
        let boxes = self.each(|v| BoxRecord {
            position: v.three(),
            half_size: v.three(),
            box_from_world: std::array::from_fn(|_| {
                let [x, y, z] = v.three();
                [x, y, z, f32::NAN]
            }),
            material: v.material(),
            ..filled()
        });
        let cylinders = self.each(|v| CylinderRecord {
            end_a: v.three(),
            end_b: v.three(),
            radius: v.one(),
            material: v.material(),
            ..filled()
        });
        let cones = self.each(|v| ConeRecord {
            apex: v.three(),
            half_angle_cosine: v.one(),
            axis: v.three(),
            height: v.one(),
            material: v.material(),
        });
        PrimitiveRecords { spheres, boxes, cylinders, cones }
    }

    fn each<T>(&mut self, mut record: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..MAX_PRIMITIVES).map(|_| record(self)).collect()
    }

    fn frame(&mut self) -> CoursePushConstants {
        CoursePushConstants {
            camera_position: self.three(),
            tile_origin: self.one() as u32,
            camera_s: self.three(),
            image_size: self.one() as u32,
            camera_u: self.three(),
            depth: self.one() as i32,
            camera_f: self.three(),
            window_low: self.one(),
            light: LightRecord { position: self.three(), intensity: self.three(), ..filled() },
            background: self.three(),
            counts: std::array::from_fn(|_| self.one() as i32),
            half_fov_tangent: self.one(),
        }
    }
}

/// Gaps hold ones all over, a NaN to whoever reads them.
fn filled<T: Pod>() -> T {
    let mut value = T::zeroed();
    bytemuck::bytes_of_mut(&mut value).fill(0xFF);
    value
}

#[test]
fn every_field_comes_back_by_its_name() {
    let device = TestDevice::open();
    let mut values = Values::default();
    let records = values.records();
    let frame = values.frame();
    // Room for more than is written: a kernel that echoes too much is seen too.
    let echo_length = values.given.len() + 8;
    let mut echo = Buffer::new(&device, "echo", BufferKind::Storage, echo_length as u64 * 4).unwrap();
    echo.write(&vec![0xFF; echo_length * 4]).unwrap();
    let echo = Arc::new(echo);

    let bindings: Vec<_> = BINDINGS.into_iter().chain([BindingKind::Storage]).collect();
    let pipeline = ComputePipeline::new(
        &device,
        &PipelineDescription {
            shader: &shaders::PROBE_LAYOUT,
            bindings: &bindings,
            push_constant_bytes: size_of::<CoursePushConstants>() as u32,
            constants: &[],
        },
    )
    .unwrap();
    let picture = Resource::from(&Arc::new(StorageImage::new(&device, "picture", 1, 1).unwrap()));
    let echo_resource = Resource::from(&echo);
    let mut resources = vec![picture.clone()];
    resources.extend(upload(&device, &records).unwrap());
    resources.push(echo_resource.clone());
    let set = BindingSet::new(&pipeline, &resources).unwrap();

    let mut commands = Commands::new(&device, "echo").unwrap();
    commands
        .run(|recorder| {
            recorder.make_ready(&picture, Use::ShaderWrite);
            recorder.dispatch(&pipeline, &set, bytes_of(&frame), [1, 1, 1]);
            recorder.make_ready(&echo_resource, Use::HostRead);
            Ok(())
        })
        .unwrap();

    let idle = commands.idle().unwrap();
    let echoed: &[f32] = cast_slice(echo.bytes(&idle).unwrap());
    let wrong: Vec<_> = (0..).zip(&values.given).zip(echoed).filter(|((_, given), back)| given != back).collect();
    assert!(wrong.is_empty(), "{} fields differ, the first: {:?}", wrong.len(), wrong.first());
    let beyond: &[u32] = cast_slice(&echoed[values.given.len()..]);
    assert!(beyond.iter().all(|&word| word == u32::MAX), "the kernel wrote past the last field");
}
