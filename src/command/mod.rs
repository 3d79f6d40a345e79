//! One file a subcommand, each a few lines over the library.

pub mod compare;
