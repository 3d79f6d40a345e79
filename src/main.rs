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
    let command = Cli::parse().command.unwrap_or_else(Command::showcase);
    let result = interrupt::listen().map_err(anyhow::Error::from).and_then(|()| command.run());
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("zerkalo: {error:#}");
            ExitCode::from(exit_code(&error))
        }
    }
}
