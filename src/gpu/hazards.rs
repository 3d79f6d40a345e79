//! Finds commands that touch one resource without a barrier between them.
//!
//! Synchronization validation does not see a missing barrier between two dispatches on one storage buffer (seen with
//! layer 1.3.239), so the recorder keeps its own book: every command says how it uses each resource, and
//! every barrier which use it makes way for. Pure: no Vulkan.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};

/// Distinguishes resources for the lifetime of the process.
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
    /// Read by kernels.
    ShaderRead,
    /// Reads, writes or both.
    ShaderWrite,
    /// Read by a copy, or by showing it in a window.
    CopySource,
    /// Written by a copy, an update or a fill.
    CopyTarget,
    /// Read by the host, once the submission has ended.
    HostRead,
}

impl Use {
    fn writes(self) -> bool {
        matches!(self, Use::ShaderWrite | Use::CopyTarget)
    }
}

/// What has happened to one resource in the commands recorded so far.
#[derive(Debug, Clone, Default)]
struct State {
    /// The commands that used it since the last barrier, with how.
    uses: Vec<(String, Use)>,
    /// What the last barrier made it ready for.
    ready: Option<Use>,
    /// Whether any command wrote it.
    is_written: bool,
}

/// The book of one command buffer, or of several that follow each other without the host's waiting in between.
#[derive(Debug, Clone, Default)]
pub struct Hazards {
    states: HashMap<ResourceId, State>,
}

impl Hazards {
    /// Notes a command's use; `Some` names the hazard when no barrier made way for it.
    ///
    /// `needs_barrier`: the resource's first use needs one too, as an image's does for its layout.
    pub fn note_use(
        &mut self,
        id: ResourceId,
        resource: &str,
        command: &str,
        as_: Use,
        needs_barrier: bool,
    ) -> Option<String> {
        let state = self.states.entry(id).or_default();
        let clash = state.uses.iter().find(|(_, before)| before.writes() || as_.writes());
        let hazard = if let Some((by, before)) = clash {
            Some(format!("{command} uses '{resource}' as {as_:?} after {by} as {before:?} without a barrier"))
        } else if (state.is_written || needs_barrier || state.ready.is_some()) && state.ready != Some(as_) {
            let ready = state.ready.map_or("nothing".to_owned(), |ready| format!("{ready:?}"));
            Some(format!("{command} uses '{resource}' as {as_:?}, but the last barrier made it ready for {ready}"))
        } else {
            None
        };
        // Once is enough: a resource that is only read needs no barrier in any number of submissions.
        if !state.uses.iter().any(|(by, before)| by == command && *before == as_) {
            state.uses.push((command.to_owned(), as_));
        }
        state.is_written |= as_.writes();
        hazard
    }

    /// Notes a barrier; returns the uses that it must wait for: those since the last barrier or, if there were none,
    /// the one that that barrier made way for.
    pub fn note_barrier(&mut self, id: ResourceId, next: Use) -> Vec<Use> {
        let state = self.states.entry(id).or_default();
        let mut before: Vec<Use> = state.uses.drain(..).map(|(_, as_)| as_).collect();
        if before.is_empty() {
            before.extend(state.ready);
        }
        state.ready = Some(next);
        before
    }

    /// What the last barrier made the resource ready for.
    pub fn ready(&self, id: ResourceId) -> Option<Use> {
        self.states.get(&id).and_then(|state| state.ready)
    }

    /// Strikes out a resource that is used no more.
    pub fn forget(&mut self, id: ResourceId) {
        self.states.remove(&id);
    }

    /// Whether a command wrote the resource and no barrier has made that visible to the host.
    pub fn is_hidden_from_host(&self, id: ResourceId) -> bool {
        self.states.get(&id).is_some_and(|state| {
            state.is_written && (state.ready != Some(Use::HostRead) || state.uses.iter().any(|(_, as_)| as_.writes()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A book with one resource.
    struct Book(Hazards, ResourceId);

    impl Book {
        fn new() -> Self {
            Self(Hazards::default(), ResourceId::fresh())
        }

        fn uses(&mut self, command: &str, as_: Use) -> Option<String> {
            self.0.note_use(self.1, "sums", command, as_, false)
        }

        fn barrier(&mut self, next: Use) -> Vec<Use> {
            self.0.note_barrier(self.1, next)
        }
    }

    #[test]
    fn two_writers_without_a_barrier_are_seen_and_with_one_are_not() {
        let mut book = Book::new();
        assert_eq!(book.uses("first", Use::ShaderWrite), None);
        let seen = book.uses("second", Use::ShaderWrite).unwrap();
        assert!(seen.contains("second") && seen.contains("'sums'") && seen.contains("first"), "{seen}");
        assert_eq!(book.barrier(Use::ShaderWrite), [Use::ShaderWrite, Use::ShaderWrite]);
        assert_eq!(book.uses("third", Use::ShaderWrite), None);
    }

    #[test]
    fn reads_may_share_but_a_write_after_them_may_not() {
        let mut book = Book::new();
        assert_eq!(book.uses("first", Use::ShaderRead), None);
        assert_eq!(book.uses("second", Use::ShaderRead), None);
        assert!(book.uses("third", Use::ShaderWrite).is_some());
    }

    #[test]
    fn a_barrier_waits_for_every_use_before_it() {
        let mut book = Book::new();
        book.uses("trace", Use::ShaderRead);
        book.uses("copy", Use::CopySource);
        assert_eq!(book.barrier(Use::ShaderWrite), [Use::ShaderRead, Use::CopySource]);
        assert_eq!(book.barrier(Use::CopySource), [Use::ShaderWrite], "nothing between: what it was ready for");
    }

    #[test]
    fn a_barrier_for_another_use_is_seen() {
        let mut book = Book::new();
        book.uses("trace", Use::ShaderWrite);
        book.barrier(Use::ShaderRead);
        assert!(book.uses("copy", Use::CopySource).is_some());
    }

    #[test]
    fn a_write_is_visible_only_to_what_the_barrier_made_way_for_even_after_a_read() {
        let mut book = Book::new();
        book.uses("trace", Use::ShaderWrite);
        book.barrier(Use::ShaderRead);
        assert_eq!(book.uses("sum", Use::ShaderRead), None);
        assert!(book.uses("copy", Use::CopySource).is_some());
    }

    #[test]
    fn a_first_use_needs_a_barrier_where_a_layout_does() {
        let (mut hazards, id) = (Hazards::default(), ResourceId::fresh());
        assert!(hazards.note_use(id, "picture", "trace", Use::ShaderWrite, true).is_some());
        let id = ResourceId::fresh();
        hazards.note_barrier(id, Use::ShaderWrite);
        assert_eq!(hazards.note_use(id, "picture", "trace", Use::ShaderWrite, true), None);
    }

    #[test]
    fn uses_repeated_without_a_barrier_do_not_pile_up() {
        let mut book = Book::new();
        (0..1000).for_each(|_| assert_eq!(book.uses("trace", Use::ShaderRead), None));
        assert_eq!(book.barrier(Use::CopyTarget), [Use::ShaderRead]);
    }

    #[test]
    fn a_forgotten_resource_starts_anew() {
        let mut book = Book::new();
        book.uses("trace", Use::ShaderWrite);
        book.0.forget(book.1);
        assert_eq!(book.uses("copy", Use::CopySource), None);
    }

    #[test]
    fn a_write_stays_hidden_from_the_host_until_a_barrier_for_it() {
        let mut book = Book::new();
        book.uses("copy", Use::CopyTarget);
        assert!(book.0.is_hidden_from_host(book.1));
        book.barrier(Use::ShaderRead);
        book.uses("sum", Use::ShaderRead);
        assert!(book.0.is_hidden_from_host(book.1));
        book.barrier(Use::HostRead);
        assert!(!book.0.is_hidden_from_host(book.1));
        book.uses("copy", Use::CopyTarget);
        assert!(book.0.is_hidden_from_host(book.1));
    }
}
