//! `feimos completions`: what a shell needs to know to complete what is typed.

use super::args::Cli;
use super::stdout::write_to_stdout;
use clap::builder::PossibleValuesParser;
use clap::{Arg, Args, Command, CommandFactory};
use clap_complete::Shell;
use feimos::accel::SplitMethod;
use feimos::error::Result;

#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// The shell.
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// Prints the script for a shell.
pub(crate) fn completions(args: &CompletionsArgs) -> Result<u8> {
    let mut command = visible(&Cli::command());
    let mut script = Vec::new();
    clap_complete::generate(
        args.shell,
        &mut command,
        env!("CARGO_PKG_NAME"),
        &mut script,
    );
    write_to_stdout(Ok(script)).map(|()| 0)
}

/// The same command without hidden flags, which the generator would offer with all others.
fn visible(command: &Command) -> Command {
    let shown = Command::new(command.get_name().to_owned())
        .about(command.get_about().cloned().unwrap_or_default())
        .args(
            command
                .get_arguments()
                .filter(|arg| !arg.is_hide_set())
                .cloned()
                .map(with_values),
        )
        .subcommands(command.get_subcommands().map(visible));
    match command.get_version() {
        Some(version) => shown.version(version.to_owned()),
        None => shown,
    }
}

/// Tells the values of a flag that the command line leaves to the library to know.
fn with_values(arg: Arg) -> Arg {
    match arg.get_id().as_str() {
        "accel" => arg.value_parser(PossibleValuesParser::new(
            SplitMethod::ALL.map(SplitMethod::name),
        )),
        _ => arg,
    }
}
