//! Table 4.1 of the course work: frames a second by kind of solids and their number.

mod agreement;
mod published;
mod speeds;

pub use agreement::{Agreement, Bend, Ratio};
pub use published::{CLAIMED_OF_SPHERES, CLAIMED_ORDER, published};
pub use speeds::Speeds;
