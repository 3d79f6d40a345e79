//! The Vulkan loader, where it needs more than its specification says.

use std::sync::{Mutex, PoisonError};

/// Does what changes the loader's list of drivers and devices (making or destroying instances, listing, making or
/// destroying devices), or for which the loader looks a device up there (naming objects, making swapchains, finding a
/// device's functions), while no other thread does such a thing.
///
/// The specification asks for nothing of the kind. But the list is one for the process and is changed without a lock:
/// a thread that names something while another destroys its device reads freed memory (Vulkan-Loader issue 2018; seen
/// with 1.4.309). Listing devices changes it too, since drivers without a device are let go then.
pub(crate) fn with_device_list<R>(work: impl FnOnce() -> R) -> R {
    static DEVICE_LIST: Mutex<()> = Mutex::new(());
    let _guard = DEVICE_LIST.lock().unwrap_or_else(PoisonError::into_inner);
    work()
}
