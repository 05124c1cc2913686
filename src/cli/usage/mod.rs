//! Parses the command line, and prints help, the version and usage errors.

mod help_texts;
mod mistake;
mod short_help;

pub(super) use help_texts::*;

use super::terminal::reporter::Reporter;
use super::terminal::stdout;
use crate::error::Error;
use clap::{ColorChoice, Command, FromArgMatches};
use std::ffi::OsString;
use std::io::{self, Write};

/// Parses the `arguments` by `command`. Answers help, the version and mistakes at once, and returns
/// their exit code as the error.
pub(super) fn parse<Cli: FromArgMatches>(
    command: Command,
    arguments: &[OsString],
) -> Result<Cli, u8> {
    let command = command.color(color_choice(arguments));
    let command = match arguments.iter().any(|argument| argument == "-h") {
        true => short_help::shortened(command),
        false => command,
    };
    let parse = |matches| Cli::from_arg_matches(&matches);
    let parsed = command
        .clone()
        .try_get_matches_from(arguments)
        .and_then(parse);
    parsed.map_err(|answer| {
        if !answer.use_stderr() {
            return print(&answer);
        }
        match mistake::about_pbrt(&answer) {
            Some(error) => report(&error),
            None => mistake::report::<Cli>(&answer, command, arguments),
        }
    })
}

/// The value of `--color`, which applies to messages about the command line, too. A mistake in it
/// is not this function's business.
fn color_choice(arguments: &[OsString]) -> ColorChoice {
    const FLAG: &str = "--color";
    let texts = arguments
        .iter()
        .map(|argument| argument.to_str().unwrap_or_default());
    let texts: Vec<&str> = texts.take_while(|text| *text != "--").collect();
    let value = |place: usize| match texts[place].strip_prefix(FLAG)? {
        "" => texts.get(place + 1).copied(),
        rest => rest.strip_prefix('='),
    };
    match (0..texts.len()).find_map(value) {
        Some("always") => ColorChoice::Always,
        Some("never") => ColorChoice::Never,
        _ => ColorChoice::Auto,
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_colour_is_found_whatever_else_is_wrong() {
        for (arguments, expected) in [
            ("feimos render --color never --foo", ColorChoice::Never),
            ("feimos --foo --color=always", ColorChoice::Always),
            ("feimos render --colormap never", ColorChoice::Auto),
            ("feimos render --color", ColorChoice::Auto),
            ("feimos render -- --color never", ColorChoice::Auto),
        ] {
            let arguments: Vec<OsString> = arguments.split(' ').map(OsString::from).collect();
            assert_eq!(color_choice(&arguments), expected, "{arguments:?}");
        }
    }
}
