//! Options of `check` as typed.

use crate::cli::args::{InputArgs, TalkArgs, threads};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Scenes: .pbrt files, `-`, bare .ply or .obj meshes, or directories, which are searched for .pbrt files that have a
    /// WorldBegin.
    #[arg(required = true, value_name = "SCENE")]
    pub(crate) scenes: Vec<PathBuf>,
    /// Print a line of JSON for each scene [default: a block for people].
    #[arg(long, help_heading = "Output")]
    pub(crate) json: bool,
    /// Take warnings for errors: exit with 1 [default: off].
    #[arg(long, help_heading = "Checking")]
    pub(crate) strict: bool,
    /// Stop at the first scene that fails [default: go on, and report at the end].
    #[arg(long, help_heading = "Checking")]
    pub(crate) fail_fast: bool,
    /// Threads to use [default: all that the process may use].
    #[arg(long, alias = "nthreads", value_name = "N", value_parser = threads, help_heading = "Checking")]
    pub(crate) threads: Option<usize>,
    #[command(flatten, next_help_heading = "Input")]
    pub(crate) input: InputArgs,
    #[command(flatten, next_help_heading = "Talk")]
    pub(crate) talk: TalkArgs,
}
