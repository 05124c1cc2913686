//! Options of `compare` as typed.

use crate::cli::args::{InputArgs, TalkArgs};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    /// The image expected: an EXR or a PNG.
    #[arg(value_name = "A")]
    pub(crate) expected: PathBuf,
    /// The image found, of the same format.
    #[arg(value_name = "B")]
    pub(crate) found: PathBuf,
    /// How far a depth, or a channel of N, P or uv, may be off before its pixel differs, in units in the last place [default: 0].
    #[arg(long, value_name = "ULPS", help_heading = "Tolerance")]
    pub(crate) max_ulp: Option<u32>,
    /// How many pixels may differ.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        help_heading = "Tolerance"
    )]
    pub(crate) max_pixels: u64,
    /// Write a picture of the differences: false hits orange, missed hits blue, wrong primitives pink, errors of depths
    /// and surfaces from green to yellow [default: none].
    #[arg(long, value_name = "OUT.png", help_heading = "Output")]
    pub(crate) diff: Option<PathBuf>,
    /// Print a line of JSON [default: a block for people].
    #[arg(long, help_heading = "Output")]
    pub(crate) json: bool,
    #[command(flatten, next_help_heading = "Input")]
    pub(crate) input: InputArgs,
    #[command(flatten, next_help_heading = "Talk")]
    pub(crate) talk: TalkArgs,
}
