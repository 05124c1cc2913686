//! Messages about wrong arguments.

use crate::error::Error;
use crate::terminal_text;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, FromArgMatches};
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::Path;

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

/// Reports what is wrong with the arguments, and returns the exit code.
///
/// The message quotes them, and they may hold anything: it is made again from printable arguments.
pub(super) fn report<Cli: FromArgMatches>(
    mistake: &clap::Error,
    command: Command,
    arguments: &[OsString],
) -> u8 {
    let printable = arguments
        .iter()
        .map(|argument| terminal_text::line(&argument.to_string_lossy()));
    let printable: Vec<String> = printable.collect();
    let tip = missing_command(mistake, &command, &printable);
    let parse = |matches| Cli::from_arg_matches(&matches);
    // If standard error is closed, the message is lost.
    let _ = match command.try_get_matches_from(printable).and_then(parse) {
        Err(mistake) if mistake.use_stderr() => with_tip(mistake, tip).print(),
        _ => io::stderr().write_all(terminal_text::lines(&mistake.render().to_string()).as_bytes()),
    };
    u8::try_from(mistake.exit_code()).unwrap_or(u8::MAX)
}

/// A tip if the user left out the command and named a scene, or a flag of a command.
fn missing_command(
    mistake: &clap::Error,
    command: &Command,
    arguments: &[String],
) -> Option<String> {
    let first = arguments.get(1)?;
    let is_mistaken = match mistake.kind() {
        ErrorKind::InvalidSubcommand => is_like_scene(Path::new(first)),
        ErrorKind::UnknownArgument => command.find_subcommand(first).is_none(),
        _ => false,
    };
    let quoted: Vec<String> = arguments[1..].iter().map(|text| quoted(text)).collect();
    let (program, quoted) = (command.get_name(), quoted.join(" "));
    is_mistaken.then(|| format!("a command comes first: {program} render {quoted}"))
}

/// An argument as a shell takes it.
fn quoted(argument: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+@%".contains(c);
    match !argument.is_empty() && argument.chars().all(is_plain) {
        true => argument.to_owned(),
        false => format!("'{}'", argument.replace('\'', r"'\''")),
    }
}

fn is_like_scene(path: &Path) -> bool {
    const EXTENSIONS: [&str; 6] = ["pbrt", "ply", "obj", "stl", "off", "gz"];
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.is_some_and(|found| EXTENSIONS.contains(&found)) || path.exists()
}

/// Adds `tip`. Without one, removes the tip to pass an unknown flag as a value: no command takes
/// values that look like flags.
fn with_tip(mut mistake: clap::Error, tip: Option<String>) -> clap::Error {
    let tips = match (tip, mistake.get(ContextKind::Suggested)) {
        (Some(tip), _) => vec![StyledStr::from(tip)],
        (None, Some(ContextValue::StyledStrs(tips))) => {
            let is_useful = |tip: &&StyledStr| !tip.to_string().starts_with("to pass");
            tips.iter().filter(is_useful).cloned().collect()
        }
        (None, _) => return mistake,
    };
    if tips.is_empty() {
        mistake.remove(ContextKind::Suggested);
    } else {
        mistake.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
    }
    mistake
}

/// The error of a flag of pbrt that has no meaning, if `mistake` is about one.
pub(super) fn about_pbrt(mistake: &clap::Error) -> Option<Error> {
    let (flag, reason) = pbrt_flag(mistake)?;
    let message = format!("{flag} has no meaning in feimos: {reason}; leave it out");
    Some(Error::usage(message))
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
