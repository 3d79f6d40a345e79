//! The program run as a user runs it, and the scripts around it.

#[path = "../budget/mod.rs"]
mod budget;
#[expect(dead_code, reason = "pictures are drawn by the program")]
#[path = "../common/mod.rs"]
mod common;
mod place;
#[path = "../random/mod.rs"]
mod random;

mod animate;
mod command_line;
mod compile;
mod fps;
mod paths;
mod report;
mod second_opinion;
mod setup;
mod ssr;
mod streams;
mod trade;
mod validate;
