//! Cases of single rays and solids.

use super::Case;

pub(super) fn cases() -> Vec<Case> {
    Vec::new()
}
