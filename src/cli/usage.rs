//! Parses the command line, and prints help, the version and usage errors.

use super::terminal::reporter::Reporter;
use super::terminal::stdout;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, FromArgMatches};
use feimos::error::Error;
use feimos::terminal_text;
use std::env::args_os;
use std::io::{self, Write};

/// Flags of pbrt that have no meaning in feimos, and why.
const PBRT_FLAGS: [(&str, &[&str]); 6] = [
    (
        "it casts one ray through the centre of each pixel",
        &[
            "--spp",
            "--quick",
            "--seed",
            "--disable-pixel-jitter",
            "--disable-wavelength-jitter",
        ],
    ),
    (
        "it computes no light",
        &["--force-diffuse", "--disable-texture-filtering"],
    ),
    (
        "it runs on the CPU",
        &["--gpu", "--gpu-device", "--wavefront"],
    ),
    (
        "it writes each image once, when it is finished",
        &[
            "--interactive",
            "--display-server",
            "--write-partial-images",
        ],
    ),
    (
        "its answers depend on no such space",
        &["--rendering-space"],
    ),
    (
        "its messages depend on --quiet and --verbose",
        &["--log-level"],
    ),
];

/// Parses the arguments of the process by `command`. Answers help, the version and mistakes at
/// once, and returns their exit code as the error.
pub(super) fn parse<Cli: FromArgMatches>(command: Command) -> Result<Cli, u8> {
    let parse = |matches| Cli::from_arg_matches(&matches);
    let parsed = command.clone().try_get_matches().and_then(parse);
    parsed.map_err(|answer| {
        if answer.use_stderr() {
            report_mistake::<Cli>(&answer, command)
        } else {
            print(&answer)
        }
    })
}

/// Prints help or the version.
fn print(answer: &clap::Error) -> u8 {
    let printed = || answer.print().and_then(|()| io::stdout().flush());
    let printed = stdout::check().and_then(|()| match printed() {
        // The user has left the pager.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        printed => printed.map_err(stdout::failed),
    });
    printed.map_or_else(|error| report(&error), |()| 0)
}

fn report(error: &Error) -> u8 {
    Reporter::silent().error(error);
    error.kind().exit_code()
}

/// Reports what is wrong with the arguments.
///
/// The message quotes them, and they may hold anything: it is made again from printable arguments.
fn report_mistake<Cli: FromArgMatches>(mistake: &clap::Error, command: Command) -> u8 {
    if let Some((flag, reason)) = pbrt_flag(mistake) {
        let message = format!("{flag} has no meaning in feimos: {reason}; leave it out");
        return report(&Error::usage(message));
    }
    let printable = args_os().map(|argument| terminal_text::line(&argument.to_string_lossy()));
    let parse = |matches| Cli::from_arg_matches(&matches);
    // If standard error is closed, the message is lost.
    let _ = match command.try_get_matches_from(printable).and_then(parse) {
        Err(mistake) if mistake.use_stderr() => mistake.print(),
        _ => io::stderr().write_all(terminal_text::lines(&mistake.render().to_string()).as_bytes()),
    };
    u8::try_from(mistake.exit_code()).unwrap_or(u8::MAX)
}

/// The flag of pbrt that `mistake` is about, and why it has no meaning.
fn pbrt_flag(mistake: &clap::Error) -> Option<(&'static str, &'static str)> {
    let ContextValue::String(found) = mistake.get(ContextKind::InvalidArg)? else {
        return None;
    };
    let flags = PBRT_FLAGS.into_iter();
    let mut flags = flags.flat_map(|(reason, flags)| flags.iter().map(move |flag| (*flag, reason)));
    let flag = flags.find(|(flag, _)| flag == found)?;
    (mistake.kind() == ErrorKind::UnknownArgument).then_some(flag)
}
