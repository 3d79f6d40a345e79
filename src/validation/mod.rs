//! Every kernel, precision and variant of a plan drawn under the validation layers, and what they have to say.

mod findings;
mod off_screen;
mod outcome;
mod runs;
mod selection;
pub(crate) mod tables;

pub use findings::{Findings, Group};
pub use off_screen::{Observe, OffScreen, Program, draw_off_screen};
pub use outcome::{Outcome, Pass, Remarked, TriedCheck};
pub use runs::{PICTURE, Run, Scope, runs};
pub use selection::{Switch, instrumented, switches};
