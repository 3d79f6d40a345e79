//! A device under validation for tests on the GPU.
use std::cell::Cell;
use std::ops::{ControlFlow, Deref};
use std::sync::Arc;

use zerkalo::frame::Frame;
use zerkalo::gpu::{Device, Message, Messages, Validation};
use zerkalo::scene::Scene;
use zerkalo::tracer::{Settings, Tracer};

/// The scene's picture by the course kernel.
pub fn render(device: &Arc<Device>, scene: &Scene, settings: &Settings) -> Frame {
    let mut tracer = Tracer::new(device, scene, settings).unwrap();
    let mut frame = tracer.frame().unwrap();
    tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
    frame
}

/// A device whose test fails on any validation message, those of its destruction among them.
///
/// `ZERKALO_DEVICE` chooses the device, as for the program. A test that finds no device fails.
pub struct TestDevice {
    device: Option<Arc<Device>>,
    messages: Messages,
    /// How many of the messages the test has asked for.
    taken: Cell<usize>,
}

impl TestDevice {
    pub fn open() -> Self {
        Self::open_with(Validation::Core)
    }

    pub fn open_with(validation: Validation) -> Self {
        let wanted = std::env::var("ZERKALO_DEVICE").ok();
        let device = Device::open(wanted.as_deref(), validation).expect("these tests need a Vulkan device");
        let messages = device.messages().clone();
        Self { device: Some(device), messages, taken: Cell::new(0) }
    }

    /// The messages since the last call, for tests that provoke them: these no longer fail the test.
    pub fn take_messages(&self) -> Vec<Message> {
        self.messages.to_vec().split_off(self.taken.replace(self.messages.count()))
    }
}

impl Deref for TestDevice {
    type Target = Arc<Device>;

    fn deref(&self) -> &Arc<Device> {
        self.device.as_ref().expect("it is there until the test ends")
    }
}

impl Drop for TestDevice {
    fn drop(&mut self) {
        let device = self.device.take().expect("it is there until the test ends");
        if std::thread::panicking() {
            return;
        }
        let left = Arc::strong_count(&device);
        drop(device);
        assert_eq!(left, 1, "something made from the device outlives the test");
        assert_eq!(self.take_messages(), [], "validation messages");
    }
}
