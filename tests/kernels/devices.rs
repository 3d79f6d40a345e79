//! Devices of one process in several threads, as `cargo test` itself and `validate` have them.

use std::thread;

use crate::common::TestDevice;
use zerkalo::gpu::{Buffer, BufferKind};

#[test]
fn devices_come_and_go_while_other_threads_name_what_they_make() {
    // Without the lock in `gpu/loader.rs`, 7 of 80 runs of this ended in a segmentation fault (loader 1.4.309, layer
    // on).
    const DEVICES: usize = 12;
    const BUFFERS: usize = 400;
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| (0..DEVICES).for_each(|_| drop(TestDevice::open())));
            scope.spawn(|| {
                let device = TestDevice::open();
                for number in 0..BUFFERS {
                    Buffer::new(&device, &format!("buffer {number}"), BufferKind::Storage, 4).unwrap();
                }
            });
        }
    });
}
