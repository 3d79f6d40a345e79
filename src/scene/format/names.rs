//! Names of primitives as scene files point at them.

use std::collections::HashMap;

use crate::scene::Primitive;

/// The names that only one primitive has.
pub(super) struct UniqueNames<'s> {
    /// Indices; `None` where several have the name.
    indices: HashMap<&'s str, Option<usize>>,
}

impl<'s> UniqueNames<'s> {
    pub fn of(primitives: &'s [Primitive]) -> Self {
        let mut indices = HashMap::new();
        for (index, primitive) in primitives.iter().enumerate() {
            if let Some(name) = &primitive.name {
                indices.entry(name.as_str()).and_modify(|known| *known = None).or_insert(Some(index));
            }
        }
        Self { indices }
    }

    /// Index of the one primitive that is called so.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.indices.get(name).copied().flatten()
    }
}
