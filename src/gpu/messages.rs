//! Validation messages, collected so that a run can fail on any of them.

use std::borrow::Cow;
use std::ffi::{CStr, c_void};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;
use serde::Serialize;

/// One message of a validation layer, or of this program's own hazard check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// The layer's id, e.g. `VUID-vkCmdDispatch-None-02699`.
    pub id: String,
    pub text: String,
}

/// A kind of message that is no fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Allowance {
    /// What such messages have in their ids.
    pub id_part: &'static str,
    /// One line.
    pub why: &'static str,
}

/// What may be said without a fault.
const ALLOWANCES: [Allowance; 2] = [
    Allowance {
        id_part: "specialuse-extension-debugging",
        why: "debug names and the layer's own settings are for debugging, as it says; they are on for that",
    },
    Allowance {
        id_part: "BestPractices-SuboptimalSwapchain",
        why: "a window was resized between two looks at its size: the picture is shown, and the next swapchain fits again",
    },
];

/// Shared list of messages; clones are the same list.
#[derive(Debug, Clone, Default)]
pub struct Messages {
    book: Arc<Mutex<Book>>,
}

#[derive(Debug, Default)]
struct Book {
    faults: Vec<Message>,
    /// How many messages of each of [`ALLOWANCES`].
    allowed: [usize; ALLOWANCES.len()],
}

impl Book {
    fn enter(&mut self, message: Message) {
        match ALLOWANCES.iter().position(|allowance| message.id.contains(allowance.id_part)) {
            Some(allowance) => self.allowed[allowance] += 1,
            None => self.faults.push(message),
        }
    }
}

impl Messages {
    pub fn push(&self, message: Message) {
        self.book().enter(message);
    }

    /// All that are faults.
    pub fn to_vec(&self) -> Vec<Message> {
        self.after(0)
    }

    /// All that are faults, but for the first `count` of them.
    pub fn after(&self, count: usize) -> Vec<Message> {
        self.book().faults.get(count..).unwrap_or_default().to_vec()
    }

    /// Of those that are faults.
    pub fn count(&self) -> usize {
        self.book().faults.len()
    }

    /// How many messages of each allowed kind there were.
    pub fn allowed(&self) -> [(Allowance, usize); ALLOWANCES.len()] {
        let counts = self.book().allowed;
        std::array::from_fn(|allowance| (ALLOWANCES[allowance], counts[allowance]))
    }

    fn book(&self) -> MutexGuard<'_, Book> {
        lock(&self.book)
    }

    /// A messenger description whose callback pushes here. The list must outlive the messenger.
    pub(super) fn messenger_info(&self) -> vk::DebugUtilsMessengerCreateInfoEXT<'_> {
        use vk::{DebugUtilsMessageSeverityFlagsEXT as Severity, DebugUtilsMessageTypeFlagsEXT as Type};
        // GENERAL is left out: the loader uses it to talk of other drivers and layers.
        let mut info = vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(Severity::WARNING | Severity::ERROR)
            .message_type(Type::VALIDATION | Type::PERFORMANCE)
            .pfn_user_callback(Some(on_message));
        info.p_user_data = Arc::as_ptr(&self.book).cast_mut().cast();
        info
    }
}

/// A panic elsewhere must not silence validation, so a poisoned book goes on.
fn lock(book: &Mutex<Book>) -> MutexGuard<'_, Book> {
    book.lock().unwrap_or_else(PoisonError::into_inner)
}

/// # Safety
/// Vulkan calls it with a valid `data`, and `user_data` is the book given in [`Messages::messenger_info`].
unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: see above; strings are null or NUL-terminated by the specification.
    let (book, id, text) = unsafe {
        let data = &*data;
        let string = |pointer: *const std::ffi::c_char| {
            if pointer.is_null() { Cow::Borrowed("") } else { CStr::from_ptr(pointer).to_string_lossy() }
        };
        (&*user_data.cast::<Mutex<Book>>(), string(data.p_message_id_name), string(data.p_message))
    };
    lock(book).enter(Message { id: id.into_owned(), text: text.into_owned() });
    vk::FALSE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_allowed_is_counted_and_no_fault() {
        let messages = Messages::default();
        for id in ["VUID-1", "BestPractices-vkCreateInstance-specialuse-extension-debugging", "VUID-2"] {
            messages.push(Message { id: id.to_owned(), text: String::new() });
        }
        assert_eq!(messages.count(), 2);
        assert_eq!(messages.after(1), [Message { id: "VUID-2".to_owned(), text: String::new() }]);
        assert_eq!(messages.after(3), []);
        assert_eq!(messages.allowed().map(|(_, count)| count), [1, 0]);
    }
}
