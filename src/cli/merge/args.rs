//! Options of `merge` as typed.

use crate::cli::args::{InputArgs, TalkArgs, threads};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct MergeArgs {
    /// Crops of one film: EXR files that were rendered with --pixelbounds, --cropwindow or a crop of the scene.
    #[arg(required = true, value_name = "CROP")]
    pub(crate) crops: Vec<PathBuf>,
    /// Where the whole goes: an .exr, or `-` for standard output.
    #[arg(
        short,
        long,
        alias = "outfile",
        value_name = "OUT",
        help_heading = "Output"
    )]
    pub(crate) output: PathBuf,
    /// Allow pixels that no crop has: they become misses, and the image ends where the crops do [default: they are an error].
    #[arg(long, help_heading = "Output")]
    pub(crate) partial: bool,
    /// Threads to use [default: all that the process may use].
    #[arg(long, alias = "nthreads", value_name = "N", value_parser = threads, help_heading = "Engine")]
    pub(crate) threads: Option<usize>,
    #[command(flatten, next_help_heading = "Input")]
    pub(crate) input: InputArgs,
    #[command(flatten, next_help_heading = "Talk")]
    pub(crate) talk: TalkArgs,
}
