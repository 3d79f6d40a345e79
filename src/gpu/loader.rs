//! The Vulkan loader, where it needs more than its specification says.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// To be held by each call that changes the loader's list of drivers and devices (instances made or destroyed, devices
/// listed, made or destroyed), and by each for which the loader looks a device up in it (objects named, swapchains made,
/// functions of a device found).
///
/// The specification asks for nothing of the kind. But the list is one for the process and is changed without a lock:
/// a thread that names something while another destroys its device reads freed memory (Vulkan-Loader issue 2018; seen
/// with 1.4.309). Listing devices changes it too, since drivers without a device are let go then.
pub(crate) fn device_list() -> MutexGuard<'static, ()> {
    static DEVICE_LIST: Mutex<()> = Mutex::new(());
    DEVICE_LIST.lock().unwrap_or_else(PoisonError::into_inner)
}
