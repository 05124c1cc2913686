//! Options of `bench` as typed.

use crate::cli::args::{InputArgs, TalkArgs, named, threads};
use clap::{Args, ValueEnum};
use feimos::accel::SplitMethod;
use feimos::bench::Kernel;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct BenchArgs {
    /// Scenes: .pbrt files, `-`, or bare .ply or .obj meshes.
    #[arg(required = true, value_name = "SCENE")]
    pub(crate) scenes: Vec<PathBuf>,
    #[command(flatten, next_help_heading = "Configurations")]
    pub(crate) configurations: ConfigurationArgs,
    #[command(flatten, next_help_heading = "Measurement")]
    pub(crate) measurement: MeasurementArgs,
    #[command(flatten, next_help_heading = "Output")]
    pub(crate) output: OutputArgs,
    #[command(flatten, next_help_heading = "Input")]
    pub(crate) input: InputArgs,
    #[command(flatten, next_help_heading = "Talk")]
    pub(crate) talk: TalkArgs,
}

#[derive(Debug, Args)]
pub(crate) struct ConfigurationArgs {
    /// Accelerators, separated by commas: none, middle, equal, sah, hlbvh [default: all].
    #[arg(long, value_name = "METHODS", value_delimiter = ',')]
    pub(crate) accel: Option<Vec<SplitMethod>>,
    /// How hits are decided, separated by commas: exact and fast as in render, exact-single a ray at a time; moeller-trumbore and
    /// watertight, which are yardsticks [default: all].
    #[arg(long, value_name = "HOW", value_delimiter = ',', value_parser = named(Kernel::ALL, Kernel::name))]
    pub(crate) precision: Option<Vec<Kernel>>,
    /// Threads to use [default: all that the process may use].
    #[arg(long, alias = "nthreads", value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<usize>,
}

#[derive(Debug, Args)]
pub(crate) struct MeasurementArgs {
    /// Rounds that are measured; each runs every configuration once.
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = runs)]
    pub(crate) runs: usize,
    /// Rounds before them that are not.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = warmup)]
    pub(crate) warmup: usize,
    /// What answers are compared with.
    #[arg(long, value_name = "WHAT", default_value = "exact")]
    pub(crate) reference: Reference,
}

/// What answers are compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Reference {
    /// Exact arithmetic on all primitives; of some pixels, where all would take long
    Exact,
    /// Nothing: times and counts alone
    None,
}

/// Where results go besides the table. `-` is standard output, in place of the table.
#[derive(Debug, Args)]
pub(crate) struct OutputArgs {
    /// Print the rows as JSON on standard output, in place of the tables [default: off].
    #[arg(long)]
    pub(crate) json: bool,
    /// Write the rows as JSON; `-` writes them to standard output, in place of the tables, as it does below [default: none].
    #[arg(long, value_name = "FILE.json")]
    pub(crate) json_file: Option<PathBuf>,
    /// Write the rows as comma-separated values [default: none].
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) csv: Option<PathBuf>,
    /// Write the tables in Markdown [default: none].
    #[arg(long, value_name = "FILE.md")]
    pub(crate) markdown: Option<PathBuf>,
    /// Write a plot of error against speed, of several scenes together [default: none].
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) plot: Option<PathBuf>,
    /// Write a page with all of it, and pictures of depths, costs and errors, to index.html in this directory [default: none].
    #[arg(long, value_name = "DIR")]
    pub(crate) report: Option<PathBuf>,
}

/// Rounds at most: a typing error should not run for ever.
const MAX_ROUNDS: usize = 10_000;

fn runs(text: &str) -> Result<usize, String> {
    rounds(text, 1)
}

fn warmup(text: &str) -> Result<usize, String> {
    rounds(text, 0)
}

fn rounds(text: &str, least: usize) -> Result<usize, String> {
    let rounds = text
        .parse()
        .ok()
        .filter(|rounds| (least..=MAX_ROUNDS).contains(rounds));
    rounds.ok_or_else(|| format!("expected a number from {least} to {MAX_ROUNDS}"))
}
