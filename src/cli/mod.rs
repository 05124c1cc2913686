//! The command line: what people type, what it means, and what they get to read.

mod args;
mod batch;
mod job;
mod manifest;
mod output_name;
mod picture;
mod plan;
mod progress_bar;
mod record;
mod reporter;
mod summary;
mod terminal;

use args::{Cli, Command};
use clap::Parser;
use feimos::error::Error;
use reporter::Reporter;
use std::process::ExitCode;

/// Runs the command that was typed and returns the exit code for it.
pub(crate) fn run() -> ExitCode {
    // clap prints help, version and its own errors, and leaves with 0 or 2.
    let cli = Cli::parse();
    let Command::Render(args) = cli.command;
    let reporter = Reporter::new(&args.talk);
    match batch::render(*args, &reporter) {
        Ok(code) => code.into(),
        Err(error) => fail(&reporter, &error),
    }
}

fn fail(reporter: &Reporter, error: &Error) -> ExitCode {
    reporter.error(error);
    error.kind().exit_code().into()
}
