//! `feimos completions`: prints a completion script for a shell.

use crate::cli::terminal::stdout::write_to_stdout;
use crate::error::Result;
use clap::{Args, Command};
use clap_complete::Shell;

#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// The shell.
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// Prints the completion script for `program`.
pub(crate) fn completions(args: &CompletionsArgs, program: Command) -> Result<u8> {
    let mut script = Vec::new();
    let name = env!("CARGO_PKG_NAME");
    clap_complete::generate(args.shell, &mut visible(&program), name, &mut script);
    write_to_stdout(Ok(script)).map(|()| 0)
}

/// The same command without hidden flags, which the generator would offer, too.
fn visible(command: &Command) -> Command {
    let args = command.get_arguments().filter(|arg| !arg.is_hide_set());
    let shown = Command::new(command.get_name().to_owned())
        .about(command.get_about().cloned().unwrap_or_default())
        .args(args.cloned())
        .subcommands(command.get_subcommands().map(visible));
    match command.get_version() {
        Some(version) => shown.version(version.to_owned()),
        None => shown,
    }
}
