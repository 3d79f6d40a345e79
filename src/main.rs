//! Parses the command line, runs one command, reports the error.

use std::io::ErrorKind;
use std::process::ExitCode;

use clap::Parser;
use zerkalo::command::{Command, READER_GONE, exit_code, interrupt};

/// A Vulkan ray tracer for simple solids with adjustable reflection.
///
/// Without a command it opens its window on the showcase scene; where there is no display, it renders the scene to
/// zerkalo.png.
#[derive(Debug, Parser)]
#[command(name = "zerkalo", version)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

fn main() -> ExitCode {
    let command = match Cli::try_parse() {
        Ok(cli) => cli.command.unwrap_or_else(showcase),
        Err(answer) => return told(&answer),
    };
    let result = interrupt::handle().map_err(anyhow::Error::from).and_then(|()| command.run());
    match result.map_err(|error| (exit_code(&error), error)) {
        Ok(()) => ExitCode::SUCCESS,
        Err((READER_GONE, _)) => ExitCode::from(READER_GONE),
        Err((code, error)) => {
            eprintln!("zerkalo: {error:#}");
            ExitCode::from(code)
        }
    }
}

/// Prints what the command line is answered with: the help that was asked for, or what is wrong.
fn told(answer: &clap::Error) -> ExitCode {
    match answer.print() {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => ExitCode::from(READER_GONE),
        // As clap itself would end: whatever else is wrong with the terminal, the code tells as much.
        Ok(()) | Err(_) => u8::try_from(answer.exit_code()).map_or(ExitCode::FAILURE, ExitCode::from),
    }
}

/// What `zerkalo` does without a word.
fn showcase() -> Command {
    let words: &[&str] = if has_display() {
        &["zerkalo", "view", "showcase"]
    } else {
        eprintln!("zerkalo: no display here, so the showcase goes into a file; see `zerkalo --help`");
        &["zerkalo", "render", "showcase", "--output", "zerkalo.png"]
    };
    // invariant: a command line without mistakes, as tests/program/command_line.rs shows.
    Cli::parse_from(words).command.expect("it has a command")
}

/// Whether a window can be hoped for: on Unix the environment names the display, elsewhere there is one.
fn has_display() -> bool {
    let is_named = |variable| std::env::var_os(variable).is_some_and(|display| !display.is_empty());
    !cfg!(all(unix, not(target_vendor = "apple")))
        || ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].into_iter().any(is_named)
}
