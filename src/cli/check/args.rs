//! Options of `check` as typed.

use crate::cli::options::cameras::CameraArgs;
use crate::cli::options::engine::ThreadArgs;
use crate::cli::options::messages::MessageArgs;
use crate::cli::options::scene::SceneArgs;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Scenes: .pbrt files, `-`, bare meshes (.ply, .obj, .stl, .off), or directories, which are
    /// searched for .pbrt files that have a WorldBegin.
    #[arg(required = true, value_name = "SCENE")]
    pub(super) scenes: Vec<PathBuf>,
    /// List each shape and each instance: its place in the file, its primitives, its size and
    /// bounds in the world, its distance from the camera, and whether it may be in view [default:
    /// only what is odd, as warnings].
    #[arg(long, help_heading = "Output")]
    pub(super) shapes: bool,
    /// Print a line of JSON for each scene [default: text].
    #[arg(long, help_heading = "Output")]
    pub(super) json: bool,
    /// Treat warnings as errors: exit with code 1 [default: off].
    #[arg(long, help_heading = "Checking")]
    pub(super) strict: bool,
    /// Stop at the first scene that fails [default: continue, and list failures at the end].
    #[arg(long, help_heading = "Checking")]
    pub(super) fail_fast: bool,
    #[command(flatten, next_help_heading = "Cameras")]
    pub(super) cameras: CameraArgs,
    #[command(flatten, next_help_heading = "Checking")]
    pub(super) threads: ThreadArgs,
    #[command(flatten, next_help_heading = "Input")]
    pub(super) input: SceneArgs,
    #[command(flatten, next_help_heading = "Messages")]
    pub(crate) messages: MessageArgs,
}
