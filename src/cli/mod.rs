//! The command line: what people type, what it means, and what they get to read.

mod args;
mod batch;
mod bench;
mod check;
#[cfg(unix)]
mod closed_stdout;
mod columns;
mod compare;
mod completions;
mod counted;
mod failures;
mod inputs;
mod job;
mod loaded_scene;
mod man;
mod manifest;
mod merge;
mod new_folders;
mod open_folders;
#[cfg(unix)]
mod out_of_memory;
mod output_name;
mod outputs;
mod panics;
mod picture;
mod pixel;
mod place;
mod plan;
mod progress_bar;
mod record;
mod reporter;
mod result_files;
mod scene_files;
#[cfg(unix)]
mod signals;
mod stdout;
mod summary;
mod terminal;
mod thread_pool;
mod timing;
mod usage;
mod version;

use args::{Command, TalkArgs};
use feimos::error::Result;
use reporter::Reporter;
use std::process::ExitCode;

/// The exit code of warnings under `--strict`.
const WARNED: u8 = 1;

/// Runs the command that was typed and returns the exit code for it.
pub(crate) fn run() -> ExitCode {
    let cli = match usage::parse() {
        Ok(cli) => cli,
        Err(code) => return code.into(),
    };
    match cli.command {
        Command::Render(args) => report(&args.talk, |reporter| batch::render(&args, reporter)),
        Command::Check(args) => report(&args.talk, |reporter| check::check(&args, reporter)),
        Command::Compare(args) => report(&args.talk, |reporter| compare::compare(&args, reporter)),
        Command::Bench(args) => report(&args.talk, |reporter| bench::bench(&args, reporter)),
        Command::Merge(args) => report(&args.talk, |reporter| merge::merge(&args, reporter)),
        Command::Pixel(args) => report(&args.talk, |reporter| pixel::pixel(&args, reporter)),
        Command::Completions(args) => {
            conclude(&Reporter::silent(), |_| completions::completions(&args))
        }
        Command::Man(args) => conclude(&Reporter::silent(), |_| man::man(&args)),
    }
}

/// Runs a command that is told how to talk.
fn report(talk: &TalkArgs, command: impl FnOnce(&Reporter) -> Result<u8>) -> ExitCode {
    conclude(&Reporter::new(talk), command)
}

/// Runs a command and tells of the error that ended it, if one did.
fn conclude(reporter: &Reporter, command: impl FnOnce(&Reporter) -> Result<u8>) -> ExitCode {
    panics::keep_messages();
    #[cfg(unix)]
    {
        signals::end_cleanly(reporter);
        out_of_memory::end_with_its_own_code();
    }
    let code = panics::guarded(None, || command(reporter)).unwrap_or_else(|error| {
        reporter.error(&error);
        error.kind().exit_code()
    });
    code.into()
}
