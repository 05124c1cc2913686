//! The command line as clap reads it, and what clap says: help, version, mistakes.

use super::args::Cli;
use super::reporter::Reporter;
use super::stdout;
use super::version;
use clap::{Command, CommandFactory, FromArgMatches};
use feimos::terminal_text;
use std::env::args_os;
use std::io::{self, Write};

/// What was typed, or the exit code where that has been answered.
pub(super) fn parse() -> Result<Cli, u8> {
    let parsed = command()
        .try_get_matches()
        .and_then(|matches| Cli::from_arg_matches(&matches));
    parsed.map_err(|answer| {
        if answer.use_stderr() {
            tell_mistake(&answer)
        } else {
            print(&answer)
        }
    })
}

fn command() -> Command {
    Cli::command().long_version(version::long_version())
}

/// Prints help or the version.
fn print(answer: &clap::Error) -> u8 {
    let printed = || answer.print().and_then(|()| io::stdout().flush());
    let printed = stdout::check().and_then(|()| match printed() {
        // A pager that was left has shown enough.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        printed => printed.map_err(stdout::failed),
    });
    printed.map_or_else(
        |error| {
            Reporter::silent().error(&error);
            error.kind().exit_code()
        },
        |()| 0,
    )
}

/// Tells what is wrong with the arguments. They are quoted, and may hold anything: the message is
/// made anew from what of them may be shown.
fn tell_mistake(mistake: &clap::Error) -> u8 {
    let shown: Vec<String> = args_os()
        .map(|argument| terminal_text::line(&argument.to_string_lossy()))
        .collect();
    let told = match command()
        .try_get_matches_from(shown)
        .and_then(|matches| Cli::from_arg_matches(&matches))
    {
        Err(mistake) if mistake.use_stderr() => mistake.print(),
        _ => io::stderr().write_all(terminal_text::lines(&mistake.render().to_string()).as_bytes()),
    };
    // Where standard error is closed there is nobody to tell.
    let _ = told;
    u8::try_from(mistake.exit_code()).unwrap_or(u8::MAX)
}
