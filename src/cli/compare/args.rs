//! Options of `compare` as typed.

use crate::cli::options::input::InputArgs;
use crate::cli::options::messages::MessageArgs;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    /// The expected image: .exr, .npy, .pfm, or a .png of 16-bit depths.
    #[arg(value_name = "A")]
    pub(super) expected: PathBuf,
    /// The image to test.
    #[arg(value_name = "B")]
    pub(super) found: PathBuf,
    /// Allow this error of depths and of N, P and uv, in units in the last place; for depths of a
    /// .png in steps.
    #[arg(
        long,
        value_name = "ULPS",
        default_value_t = 0,
        help_heading = "Tolerance"
    )]
    pub(super) max_ulp: u32,
    /// Allow this many pixels to differ.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        help_heading = "Tolerance"
    )]
    pub(super) max_pixels: u64,
    /// Write a picture of the differences: false hits orange, missed hits blue, wrong primitives
    /// pink, errors of depths and surfaces from green to yellow [default: none].
    #[arg(long, value_name = "OUT.png", help_heading = "Output")]
    pub(super) diff: Option<PathBuf>,
    /// Print a line of JSON [default: text].
    #[arg(long, help_heading = "Output")]
    pub(super) json: bool,
    #[command(flatten, next_help_heading = "Input")]
    pub(super) input: InputArgs,
    #[command(flatten, next_help_heading = "Messages")]
    pub(crate) messages: MessageArgs,
}
