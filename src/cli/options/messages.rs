//! Options for messages: how much a command prints, and in which form.

use clap::{Args, ValueEnum};

/// The exit code of warnings under `--strict`.
pub(crate) const WARNED: u8 = 1;

#[derive(Debug, Args)]
pub(crate) struct MessageArgs {
    /// Print errors only [default: also results and warnings].
    #[arg(short, long, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Print more: the results of each phase, notes of little use, and each repetition of a message
    /// [default: off].
    #[arg(short, long)]
    pub(crate) verbose: bool,
    /// Show progress bars.
    #[arg(
        long,
        value_name = "WHEN",
        default_value = "auto",
        hide_short_help = true
    )]
    pub(crate) progress: When,
    /// Colour messages.
    #[arg(
        long,
        value_name = "WHEN",
        default_value = "auto",
        hide_short_help = true
    )]
    pub(crate) color: When,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum When {
    /// On a terminal.
    Auto,
    /// Everywhere.
    Always,
    /// Nowhere.
    Never,
}

#[derive(Debug, Args)]
pub(crate) struct ReportArgs {
    /// Print statistics: what was traced and how fast, and what rays test in a tree, which are
    /// counted after the image is written [default: off].
    #[arg(long)]
    pub(crate) stats: bool,
    /// Print a line of JSON for each image on standard output [default: off].
    #[arg(long)]
    pub(crate) json: bool,
    /// Treat warnings as errors: exit with code 1 [default: off].
    #[arg(long, hide_short_help = true)]
    pub(crate) strict: bool,
}
