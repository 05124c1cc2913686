//! Options of `render` as typed.

use crate::cli::options::batch::BatchArgs;
use crate::cli::options::cameras::CameraArgs;
use crate::cli::options::engine::EngineArgs;
use crate::cli::options::messages::{MessageArgs, ReportArgs};
use crate::cli::options::output::OutputArgs;
use crate::cli::options::region::RegionArgs;
use crate::cli::options::scene::SceneArgs;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct RenderArgs {
    /// Scenes: .pbrt files, `-`, or bare meshes: .ply, .obj, .stl, .off.
    #[arg(required = true, value_name = "SCENE")]
    pub(crate) scenes: Vec<PathBuf>,
    #[command(flatten, next_help_heading = "Output")]
    pub(crate) output: OutputArgs,
    #[command(flatten, next_help_heading = "Region")]
    pub(crate) region: RegionArgs,
    #[command(flatten, next_help_heading = "Engine")]
    pub(crate) engine: EngineArgs,
    #[command(flatten, next_help_heading = "Cameras and batches")]
    pub(crate) cameras: CameraArgs,
    #[command(flatten, next_help_heading = "Cameras and batches")]
    pub(crate) batch: BatchArgs,
    #[command(flatten, next_help_heading = "Input")]
    pub(crate) input: SceneArgs,
    #[command(flatten, next_help_heading = "Messages")]
    pub(crate) messages: MessageArgs,
    #[command(flatten, next_help_heading = "Messages")]
    pub(crate) report: ReportArgs,
}
