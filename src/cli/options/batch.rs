//! Options for batches: several images, and images that exist.

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct BatchArgs {
    /// Overwrite existing images: also if the command writes several, and also files that the scene
    /// names and feimos did not write [default: both are errors].
    #[arg(long, conflicts_with = "skip_existing")]
    pub(crate) force: bool,
    /// Skip images that are done: they exist and come from the same scene and options; works with
    /// .exr and .png [default: off].
    #[arg(long)]
    pub(crate) skip_existing: bool,
    /// Stop at the first image that fails [default: continue, and list failures at the end].
    #[arg(long, hide_short_help = true)]
    pub(crate) fail_fast: bool,
    /// Append a line of JSON for each image to this file [default: none].
    #[arg(long, value_name = "FILE.jsonl", hide_short_help = true)]
    pub(crate) manifest: Option<PathBuf>,
}
