//! A missing barrier is seen. Neither the result on a CPU device nor the validation layer (1.3.239) shows the lack of
//! one between two dispatches on one buffer: they pass over it in silence, so the program keeps its own book.

use std::sync::Arc;

use crate::common::TestDevice;
use bytemuck::cast_slice;
use zerkalo::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, Commands, ComputePipeline, GpuError, InFlight, PipelineDescription,
    Resource, Use, shaders,
};

/// Invocations of the probe's one workgroup.
const COUNT: usize = 64;

/// `glsl/probe/sum.comp` with its buffer, which starts as row 0 of Pascal's triangle.
struct Probe {
    pipeline: Arc<ComputePipeline>,
    set: Arc<BindingSet>,
    numbers: Arc<Buffer>,
    resource: Resource,
    commands: Commands,
}

impl Probe {
    fn new(device: &TestDevice) -> Self {
        let mut numbers = Buffer::new(device, "numbers", BufferKind::Storage, COUNT as u64 * 4).unwrap();
        let mut row_0 = [0_u32; COUNT];
        row_0[0] = 1;
        numbers.write(cast_slice(&row_0)).unwrap();
        let numbers = Arc::new(numbers);
        let description = PipelineDescription {
            shader: &shaders::PROBE_SUM,
            bindings: &[BindingKind::Storage],
            push_constant_bytes: 0,
            constants: &[],
        };
        let pipeline = ComputePipeline::new(device, &description).unwrap();
        let resource = Resource::from(&numbers);
        let set = BindingSet::new(&pipeline, std::slice::from_ref(&resource)).unwrap();
        Self { pipeline, set, numbers, resource, commands: Commands::new(device, "sum").unwrap() }
    }

    fn row(&mut self) -> Vec<u32> {
        cast_slice(self.numbers.bytes(&self.commands.idle().unwrap()).unwrap()).to_vec()
    }

    /// `dispatches` in one submission, with or without the barriers between them and the one before the host reads.
    fn run(&mut self, dispatches: usize, between: bool, before_host: bool) {
        let Self { pipeline, set, resource, commands, .. } = self;
        commands
            .run(|recorder| {
                for index in 0..dispatches {
                    if between && index > 0 {
                        recorder.make_ready(resource, Use::ShaderWrite);
                    }
                    recorder.dispatch(pipeline, set, &[], [1, 1, 1]);
                }
                if before_host {
                    recorder.make_ready(resource, Use::HostRead);
                }
                Ok(())
            })
            .unwrap();
    }
}

/// What the program's own check said. A layer that learns to see such things may say so too, and nothing else.
fn own_hazards(device: &TestDevice) -> Vec<String> {
    let (own, others): (Vec<_>, Vec<_>) =
        device.take_messages().into_iter().partition(|message| message.id == "zerkalo-hazard");
    assert!(others.iter().all(|message| message.id.starts_with("SYNC-HAZARD")), "{others:?}");
    own.into_iter().map(|message| message.text).collect()
}

#[test]
fn two_dispatches_on_one_buffer_without_a_barrier_are_seen() {
    let device = TestDevice::open();
    let mut probe = Probe::new(&device);
    probe.run(2, false, true);
    let hazards = own_hazards(&device);
    let [hazard] = &hazards[..] else { panic!("one hazard was recorded: {hazards:?}") };
    for part in ["probe_sum", "'numbers'", "without a barrier"] {
        assert!(hazard.contains(part), "{part} is not in: {hazard}");
    }
}

#[test]
fn every_missing_barrier_of_many_is_seen() {
    let device = TestDevice::open();
    Probe::new(&device).run(5, false, true);
    assert_eq!(own_hazards(&device).len(), 4);
}

#[test]
fn dispatches_with_barriers_between_are_silent_and_add_up() {
    let device = TestDevice::open();
    let mut probe = Probe::new(&device);
    probe.run(5, true, true);
    assert_eq!(device.take_messages(), []);
    let row = probe.row();
    assert_eq!(row[..7], [1, 5, 10, 10, 5, 1, 0], "row 5 of Pascal's triangle");
    assert!(row[7..].iter().all(|&number| number == 0));
}

#[test]
fn a_missing_barrier_before_the_host_reads_is_seen() {
    let device = TestDevice::open();
    Probe::new(&device).run(1, true, false);
    let hazards = own_hazards(&device);
    let [hazard] = &hazards[..] else { panic!("one hazard was recorded: {hazards:?}") };
    assert!(hazard.contains("'numbers'") && hazard.contains("host"), "{hazard}");
}

#[test]
fn submissions_are_waited_for_and_need_no_barrier_between_them() {
    let device = TestDevice::open();
    let mut probe = Probe::new(&device);
    probe.run(1, true, true);
    probe.run(1, true, true);
    assert_eq!(device.take_messages(), []);
    let row = probe.row();
    assert_eq!(row[..4], [1, 2, 1, 0], "row 2 of Pascal's triangle");
}

/// Of submissions that follow each other without the host's waiting.
#[test]
fn a_recording_that_fails_leaves_nothing_in_the_book() {
    let device = TestDevice::open();
    let Probe { pipeline, set, resource, .. } = Probe::new(&device);
    let mut in_flight = InFlight::new(&device, "sum").unwrap();
    let failure = || GpuError::NotMapped { object: "a test's".to_owned() };
    let failed = in_flight.run(|recorder| {
        recorder.dispatch(&pipeline, &set, &[], [1, 1, 1]);
        Err(failure())
    });
    assert!(failed.is_err());
    // Not after the dispatch that was never submitted.
    in_flight
        .run(|recorder| {
            recorder.dispatch(&pipeline, &set, &[], [1, 1, 1]);
            recorder.make_ready(&resource, Use::HostRead);
            Ok(())
        })
        .unwrap();
    assert_eq!(device.take_messages(), []);
}
