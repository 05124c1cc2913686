//! The command line: what people type, what it means, and what they get to read.

mod args;
mod batch;
mod bench;
mod check;
mod columns;
mod compare;
mod completions;
mod counted;
mod failures;
mod job;
mod loaded_scene;
mod man;
mod manifest;
mod merge;
#[cfg(unix)]
mod out_of_memory;
mod output_name;
mod outputs;
mod picture;
mod pixel;
mod plan;
mod progress_bar;
mod record;
mod reporter;
mod scene_files;
#[cfg(unix)]
mod signals;
mod stdout;
mod summary;
mod terminal;
mod thread_pool;
mod timing;
mod version;

use args::{Cli, Command, TalkArgs};
use clap::{CommandFactory, FromArgMatches};
use feimos::error::Result;
use reporter::Reporter;
use std::process::ExitCode;

/// The exit code of warnings under `--strict`.
const WARNED: u8 = 1;

/// Runs the command that was typed and returns the exit code for it.
pub(crate) fn run() -> ExitCode {
    // clap prints help, version and its own errors, and leaves with 0 or 2.
    let matches = Cli::command().long_version(version::long_version()).get_matches();
    let cli = Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    match cli.command {
        Command::Render(args) => report(&args.talk, |reporter| batch::render(&args, reporter)),
        Command::Check(args) => report(&args.talk, |reporter| check::check(&args, reporter)),
        Command::Compare(args) => report(&args.talk, |reporter| compare::compare(&args, reporter)),
        Command::Bench(args) => report(&args.talk, |reporter| bench::bench(&args, reporter)),
        Command::Merge(args) => report(&args.talk, |reporter| merge::merge(&args, reporter)),
        Command::Pixel(args) => report(&args.talk, |reporter| pixel::pixel(&args, reporter)),
        Command::Completions(args) => conclude(&Reporter::silent(), |_| completions::completions(&args)),
        Command::Man(args) => conclude(&Reporter::silent(), |_| man::man(&args)),
    }
}

/// Runs a command that is told how to talk.
fn report(talk: &TalkArgs, command: impl FnOnce(&Reporter) -> Result<u8>) -> ExitCode {
    conclude(&Reporter::new(talk), command)
}

/// Runs a command and tells of the error that ended it, if one did.
fn conclude(reporter: &Reporter, command: impl FnOnce(&Reporter) -> Result<u8>) -> ExitCode {
    #[cfg(unix)]
    {
        signals::end_cleanly(reporter);
        out_of_memory::end_with_its_own_code();
    }
    let code = command(reporter).unwrap_or_else(|error| {
        reporter.error(&error);
        error.kind().exit_code()
    });
    code.into()
}
