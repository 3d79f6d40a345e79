//! Finds commands that touch one resource without a barrier between them.
//!
//! Synchronization validation does not see a missing barrier between two dispatches on one storage buffer (STACK:
//! seen with layer 1.3.239), so the recorder keeps its own book: every command says how it uses each resource, and
//! every barrier which use it makes way for. Pure: no Vulkan.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};

/// Tells resources apart for the lifetime of the process.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ResourceId(u64);

impl ResourceId {
    pub fn fresh() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// How a command uses a resource.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    ShaderRead,
    /// Reads, writes or both.
    ShaderWrite,
    CopySource,
    CopyTarget,
    HostRead,
}

impl Use {
    fn writes(self) -> bool {
        matches!(self, Use::ShaderWrite | Use::CopyTarget)
    }
}

/// What has happened to one resource in the command buffer being recorded.
#[derive(Debug, Clone)]
enum State {
    /// Used by a command, no barrier since.
    Used { by: String, as_: Use },
    /// A barrier made it ready for this use, no command since.
    Ready(Use),
}

/// The book of one command buffer. The host waits for each submission, so nothing is owed between two of them.
#[derive(Debug, Default)]
pub struct Hazards {
    states: HashMap<ResourceId, State>,
}

impl Hazards {
    /// Notes a command's use; `Some` names the hazard when no barrier made way for it.
    pub fn note_use(&mut self, id: ResourceId, resource: &str, command: &str, as_: Use) -> Option<String> {
        let hazard = match self.states.get(&id) {
            Some(State::Used { by, as_: before }) if before.writes() || as_.writes() => {
                Some(format!("{command} uses '{resource}' as {as_:?} after {by} as {before:?} without a barrier"))
            }
            Some(State::Ready(ready)) if *ready != as_ => {
                Some(format!("{command} uses '{resource}' as {as_:?}, but the barrier made it ready for {ready:?}"))
            }
            _ => None,
        };
        self.states.insert(id, State::Used { by: command.to_owned(), as_ });
        hazard
    }

    /// Notes a barrier; returns the use that it must wait for, if there was one.
    pub fn note_barrier(&mut self, id: ResourceId, next: Use) -> Option<Use> {
        match self.states.insert(id, State::Ready(next)) {
            Some(State::Used { as_, .. } | State::Ready(as_)) => Some(as_),
            None => None,
        }
    }

    /// Whether the device wrote the resource and no barrier has made that visible yet.
    pub fn has_unseen_write(&self, id: ResourceId) -> bool {
        matches!(self.states.get(&id), Some(State::Used { as_, .. }) if as_.writes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_writers_without_a_barrier_are_seen_and_with_one_are_not() {
        let (mut hazards, id) = (Hazards::default(), ResourceId::fresh());
        assert_eq!(hazards.note_use(id, "sums", "first", Use::ShaderWrite), None);
        let seen = hazards.note_use(id, "sums", "second", Use::ShaderWrite).unwrap();
        assert!(seen.contains("second") && seen.contains("'sums'") && seen.contains("first"), "{seen}");
        assert_eq!(hazards.note_barrier(id, Use::ShaderWrite), Some(Use::ShaderWrite));
        assert_eq!(hazards.note_use(id, "sums", "third", Use::ShaderWrite), None);
    }

    #[test]
    fn reads_may_share_but_a_write_after_them_may_not() {
        let (mut hazards, id) = (Hazards::default(), ResourceId::fresh());
        assert_eq!(hazards.note_use(id, "spheres", "first", Use::ShaderRead), None);
        assert_eq!(hazards.note_use(id, "spheres", "second", Use::ShaderRead), None);
        assert!(hazards.note_use(id, "spheres", "third", Use::ShaderWrite).is_some());
    }

    #[test]
    fn a_barrier_for_another_use_is_seen() {
        let (mut hazards, id) = (Hazards::default(), ResourceId::fresh());
        hazards.note_use(id, "picture", "trace", Use::ShaderWrite);
        hazards.note_barrier(id, Use::ShaderRead);
        assert!(hazards.note_use(id, "picture", "copy", Use::CopySource).is_some());
    }

    #[test]
    fn a_write_stays_unseen_until_a_barrier() {
        let (mut hazards, id) = (Hazards::default(), ResourceId::fresh());
        hazards.note_use(id, "pixels", "copy", Use::CopyTarget);
        assert!(hazards.has_unseen_write(id));
        hazards.note_barrier(id, Use::HostRead);
        assert!(!hazards.has_unseen_write(id));
    }
}
