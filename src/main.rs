//! Parses the command line, runs one command, reports the error.

use std::process::ExitCode;

use clap::Parser;
use zerkalo::command::{Command, exit_code, interrupt};

/// A Vulkan ray tracer for simple solids with adjustable reflection.
///
/// Without a command it renders the showcase scene to zerkalo.png.
#[derive(Debug, Parser)]
#[command(name = "zerkalo", version)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

fn main() -> ExitCode {
    let command = Cli::parse().command.unwrap_or_else(showcase);
    let result = interrupt::handle().map_err(anyhow::Error::from).and_then(|()| command.run());
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("zerkalo: {error:#}");
            ExitCode::from(exit_code(&error))
        }
    }
}

/// What `zerkalo` does without a word.
fn showcase() -> Command {
    let words = ["zerkalo", "render", "showcase", "--output", "zerkalo.png"];
    // invariant: a command line without mistakes, as tests/command_line.rs shows.
    Cli::parse_from(words).command.expect("it has a command")
}
