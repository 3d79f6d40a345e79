//! Validation messages, collected so that a run can fail on any of them.

use std::borrow::Cow;
use std::ffi::{CStr, c_void};
use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;

/// One message of a validation layer, or of this program's own hazard check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// The layer's id, e.g. `VUID-vkCmdDispatch-None-02699`.
    pub id: String,
    pub text: String,
}

/// Shared list of messages; clones are the same list.
#[derive(Debug, Clone, Default)]
pub struct Messages {
    list: Arc<Mutex<Vec<Message>>>,
}

impl Messages {
    pub fn push(&self, message: Message) {
        // A panic elsewhere must not silence validation, so a poisoned list goes on.
        self.list.lock().unwrap_or_else(PoisonError::into_inner).push(message);
    }

    pub fn to_vec(&self) -> Vec<Message> {
        self.list.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub fn count(&self) -> usize {
        self.list.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// A messenger description whose callback pushes here. The list must outlive the messenger.
    pub(super) fn messenger_info(&self) -> vk::DebugUtilsMessengerCreateInfoEXT<'_> {
        use vk::{DebugUtilsMessageSeverityFlagsEXT as Severity, DebugUtilsMessageTypeFlagsEXT as Type};
        // GENERAL is left out: the loader uses it to talk of other drivers and layers.
        let mut info = vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(Severity::WARNING | Severity::ERROR)
            .message_type(Type::VALIDATION | Type::PERFORMANCE)
            .pfn_user_callback(Some(on_message));
        info.p_user_data = Arc::as_ptr(&self.list).cast_mut().cast();
        info
    }
}

/// Messages that are no fault, each by a part of its id, and why.
const NO_FAULT: [&str; 2] = [
    // Debug names and the layer's own settings are for debugging, as it says; they are on for that.
    "specialuse-extension-debugging",
    // A window resized between two looks at its size: the picture is shown, and the next frame's swapchain fits again.
    "BestPractices-SuboptimalSwapchain",
];

/// # Safety
/// Vulkan calls it with a valid `data`, and `user_data` is the list given in [`Messages::messenger_info`].
unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: see above; strings are null or NUL-terminated by the specification.
    let (list, id, text) = unsafe {
        let data = &*data;
        let string = |pointer: *const std::ffi::c_char| {
            if pointer.is_null() { Cow::Borrowed("") } else { CStr::from_ptr(pointer).to_string_lossy() }
        };
        (&*user_data.cast::<Mutex<Vec<Message>>>(), string(data.p_message_id_name), string(data.p_message))
    };
    if !NO_FAULT.iter().any(|part| id.contains(part)) {
        let message = Message { id: id.into_owned(), text: text.into_owned() };
        list.lock().unwrap_or_else(PoisonError::into_inner).push(message);
    }
    vk::FALSE
}
