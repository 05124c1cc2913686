//! Options of `bench` as typed.

use super::args::{TalkArgs, threads};
use clap::Args;
use feimos::accel::{Precision, SplitMethod};
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
    /// Write the rows as JSON to this file; `-` writes them to standard output, in place of the table.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) json: Option<PathBuf>,
    #[command(flatten, next_help_heading = "Talk")]
    pub(crate) talk: TalkArgs,
}

#[derive(Debug, Args)]
pub(crate) struct ConfigurationArgs {
    /// Accelerators, separated by commas: none, middle, equal, sah, hlbvh [default: all; none only where it is not
    /// hopeless].
    #[arg(long, value_name = "METHODS", value_delimiter = ',')]
    pub(crate) accel: Option<Vec<SplitMethod>>,
    /// Precisions, separated by commas: exact, fast [default: all].
    #[arg(long, value_name = "HOW", value_delimiter = ',')]
    pub(crate) precision: Option<Vec<Precision>>,
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
    #[arg(long, value_name = "WHAT", default_value = "none", value_parser = reference)]
    pub(crate) reference: Reference,
}

/// What answers are compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reference {
    /// Nothing: times and counts alone.
    None,
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
    let rounds = text.parse().ok().filter(|rounds| (least..=MAX_ROUNDS).contains(rounds));
    rounds.ok_or_else(|| format!("expected a number from {least} to {MAX_ROUNDS}"))
}

fn reference(text: &str) -> Result<Reference, String> {
    match text {
        "none" => Ok(Reference::None),
        "exact" => Err("not available yet; expected none, which measures times and counts alone".to_owned()),
        _ => Err("expected none".to_owned()),
    }
}
