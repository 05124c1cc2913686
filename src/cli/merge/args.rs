//! Options of `merge` as typed.

use crate::cli::options::engine::ThreadArgs;
use crate::cli::options::input::InputArgs;
use crate::cli::options::messages::MessageArgs;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct MergeArgs {
    /// Crops of one film: EXR files rendered with --pixelbounds, --cropwindow or a crop in the
    /// scene.
    #[arg(required = true, value_name = "CROP")]
    pub(super) crops: Vec<PathBuf>,
    /// Name the merged image: an .exr, or `-` for standard output.
    #[arg(
        short,
        long,
        alias = "outfile",
        value_name = "OUT",
        help_heading = "Output"
    )]
    pub(super) output: PathBuf,
    /// Allow pixels that no crop covers: they become misses, and the image ends where the crops do
    /// [default: they are an error].
    #[arg(long, help_heading = "Output")]
    pub(super) partial: bool,
    #[command(flatten, next_help_heading = "Engine")]
    pub(super) threads: ThreadArgs,
    #[command(flatten, next_help_heading = "Input")]
    pub(super) input: InputArgs,
    #[command(flatten, next_help_heading = "Messages")]
    pub(crate) messages: MessageArgs,
}
