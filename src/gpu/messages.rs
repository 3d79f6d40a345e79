//! Validation messages, collected so that a run can fail on any of them.

use std::borrow::Cow;
use std::ffi::{CStr, c_void};
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;
use serde::Serialize;

/// How a message was marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Anything less than an error, such as advice of best practices.
    Warning,
    /// Against the specification, or a hazard that this program saw itself.
    Error,
}

impl Severity {
    /// As JSON and printed lines have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// One message of a validation layer, or of this program's own hazard check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// As the layer marked it, or an error for a hazard.
    pub severity: Severity,
    /// The layer's id, e.g. `VUID-vkCmdDispatch-None-02699`.
    pub id: String,
    /// The layer's or the recorder's sentence, which names the objects concerned.
    pub text: String,
}

/// What a layer is known to say that is no fault of a call: about its own set-up, or about what a user did.
///
/// A message is one only if all of it fits, so that no error and no other warning hides behind it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Remark {
    /// The whole id.
    pub id: &'static str,
    /// What a message must be marked with.
    pub severity: Severity,
    /// What its text has in it.
    pub text_part: &'static str,
    /// First and last version of the layer, as Vulkan encodes them, for which it is known.
    #[serde(skip)]
    layers: [u32; 2],
    /// One line.
    pub why: &'static str,
}

const fn layer(minor: u32, patch: u32) -> u32 {
    vk::make_api_version(0, 1, minor, patch)
}

/// The layer whose ids have been seen to differ from those before.
const FIRST_OF_1_4: u32 = layer(4, 304);
const LAST_OF_1_3: u32 = layer(3, 999);
/// No end is known.
const ANY_LATER: u32 = u32::MAX;

const DEBUG_NAMES: &str =
    "debug names and messages are for debugging, as the layer says; under validation they are on for that";
const RESIZED: &str =
    "a window was resized between two looks at its size: the picture is shown, and the next swapchain fits again";

const REMARKS: [Remark; 5] = [
    Remark {
        id: "UNASSIGNED-BestPractices-vkCreateInstance-specialuse-extension-debugging",
        severity: Severity::Warning,
        text_part: "",
        layers: [layer(3, 200), LAST_OF_1_3],
        why: DEBUG_NAMES,
    },
    Remark {
        id: "BestPractices-specialuse-extension",
        severity: Severity::Warning,
        text_part: "VK_EXT_debug_utils",
        layers: [FIRST_OF_1_4, ANY_LATER],
        why: DEBUG_NAMES,
    },
    Remark {
        id: "UNASSIGNED-BestPractices-SuboptimalSwapchain",
        severity: Severity::Warning,
        text_part: "",
        layers: [layer(3, 200), LAST_OF_1_3],
        why: RESIZED,
    },
    Remark {
        id: "BestPractices-vkCreateSharedSwapchainsKHR-SuboptimalSwapchain",
        severity: Severity::Warning,
        text_part: "",
        layers: [FIRST_OF_1_4, ANY_LATER],
        why: RESIZED,
    },
    Remark {
        id: "VALIDATION-SETTINGS",
        severity: Severity::Warning,
        text_part: "Both GPU Assisted Validation and Normal Core Check Validation are enabled",
        layers: [FIRST_OF_1_4, ANY_LATER],
        why: "all checks were asked for at once, which is slow, as the layer says",
    },
];

impl Remark {
    fn fits(&self, message: &Message, layer: u32) -> bool {
        let [first, last] = self.layers;
        self.id == message.id
            && self.severity == message.severity
            && message.text.contains(self.text_part)
            && (first..=last).contains(&layer)
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} ({}): {}", self.id, self.severity.name(), self.why)
    }
}

/// Shared list of messages; clones are the same list.
#[derive(Debug, Clone, Default)]
pub struct Messages {
    book: Arc<Mutex<Book>>,
}

#[derive(Debug, Default)]
struct Book {
    faults: Vec<Message>,
    /// How many messages of each of [`REMARKS`].
    remarks: [usize; REMARKS.len()],
    /// Version of the validation layer that speaks, as Vulkan encodes it.
    layer: u32,
}

impl Book {
    fn enter(&mut self, message: Message) {
        match REMARKS.iter().position(|remark| remark.fits(&message, self.layer)) {
            Some(remark) => self.remarks[remark] += 1,
            None => self.faults.push(message),
        }
    }
}

impl Messages {
    /// Enters a message among the faults, or counts it where it is a known [`Remark`] of the layer in use.
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

    /// Number of those that are faults.
    pub fn count(&self) -> usize {
        self.book().faults.len()
    }

    /// The remarks that were made, each with how often.
    pub fn remarks(&self) -> Vec<(Remark, usize)> {
        let counts = self.book().remarks;
        REMARKS.into_iter().zip(counts).filter(|(_, count)| *count > 0).collect()
    }

    /// All remarks that are known.
    pub fn every_remark() -> Vec<Remark> {
        REMARKS.to_vec()
    }

    /// Sets which layer's remarks to expect: a version as Vulkan encodes it.
    pub(super) fn set_layer_version(&self, version: u32) {
        self.book().layer = version;
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
    severity: vk::DebugUtilsMessageSeverityFlagsEXT,
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
    let is_error = severity.contains(vk::DebugUtilsMessageSeverityFlagsEXT::ERROR);
    let severity = if is_error { Severity::Error } else { Severity::Warning };
    lock(book).enter(Message { severity, id: id.into_owned(), text: text.into_owned() });
    vk::FALSE
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAYERS: [u32; 2] = [layer(3, 239), layer(4, 309)];

    fn said(layer: u32, severity: Severity, id: &str, text: &str) -> Messages {
        let messages = Messages::default();
        messages.set_layer_version(layer);
        messages.push(Message { severity, id: id.to_owned(), text: text.to_owned() });
        messages
    }

    #[test]
    fn what_a_layer_says_of_itself_is_told_apart_and_counted() {
        for remark in REMARKS {
            let text = format!("vkCreateInstance(): {}, and more", remark.text_part);
            let is_known = |layer| said(layer, remark.severity, remark.id, &text).remarks() == [(remark, 1)];
            assert_eq!(
                LAYERS.map(is_known),
                LAYERS.map(|layer| (remark.layers[0]..=remark.layers[1]).contains(&layer))
            );
            assert!(LAYERS.into_iter().any(is_known), "{} is of no layer that was tried", remark.id);
        }
    }

    #[test]
    fn no_error_no_other_id_no_other_text_and_no_other_layer_hides_behind_it() {
        for remark in REMARKS {
            let text = format!("vkCreateInstance(): {}", remark.text_part);
            let is_fault = |messages: Messages| messages.count() == 1 && messages.remarks().is_empty();
            for layer in LAYERS {
                assert!(is_fault(said(layer, Severity::Error, remark.id, &text)), "{}", remark.id);
                assert!(is_fault(said(layer, remark.severity, &format!("{}-02699", remark.id), &text)));
                assert!(is_fault(said(layer, remark.severity, "VUID-vkCmdDispatch-None-02699", &text)));
                if !remark.text_part.is_empty() {
                    assert!(is_fault(said(layer, remark.severity, remark.id, "VK_EXT_another")), "{}", remark.id);
                }
            }
            assert!(is_fault(said(layer(2, 100), remark.severity, remark.id, &text)), "{}", remark.id);
        }
    }

    #[test]
    fn faults_are_kept_in_their_order() {
        let messages = said(LAYERS[0], Severity::Error, "VUID-1", "");
        let second = Message { severity: Severity::Warning, id: "VUID-2".to_owned(), text: String::new() };
        messages.push(second.clone());
        assert_eq!(messages.count(), 2);
        assert_eq!(messages.after(1), [second]);
        assert_eq!(messages.after(3), []);
    }
}
