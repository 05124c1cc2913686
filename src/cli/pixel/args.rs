//! Options of `pixel` as typed.

use crate::accel::SplitMethod;
use crate::cli::options::cameras::CameraArgs;
use crate::cli::options::engine::ThreadArgs;
use crate::cli::options::messages::MessageArgs;
use crate::cli::options::scene::SceneArgs;
use crate::cli::options::values::{integers, named, resolution};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct PixelArgs {
    /// The scene: a .pbrt file, `-`, or a bare mesh: .ply, .obj, .stl, .off.
    #[arg(value_name = "SCENE")]
    pub(super) scene: PathBuf,
    /// Column and row of the pixel, counted from 0 at the upper left corner of the film.
    #[arg(value_name = "X,Y", value_parser = integers::<2>, allow_hyphen_values = true)]
    pub(super) pixel: [u32; 2],
    /// Print one JSON object [default: text].
    #[arg(long, help_heading = "Output")]
    pub(super) json: bool,
    /// Set the width and height of the film [default: the scene's].
    #[arg(long, value_name = "WxH", value_parser = resolution, allow_hyphen_values = true)]
    #[arg(help_heading = "Region")]
    pub(super) resolution: Option<[u32; 2]>,
    /// Count the cost with this accelerator alone [default: with each].
    #[arg(long, value_name = "METHOD", help_heading = "Engine")]
    #[arg(value_parser = named(SplitMethod::ALL, SplitMethod::name))]
    pub(super) accel: Option<SplitMethod>,
    #[command(flatten, next_help_heading = "Cameras")]
    pub(super) cameras: CameraArgs,
    #[command(flatten, next_help_heading = "Engine")]
    pub(super) threads: ThreadArgs,
    #[command(flatten, next_help_heading = "Input")]
    pub(super) input: SceneArgs,
    #[command(flatten, next_help_heading = "Messages")]
    pub(crate) messages: MessageArgs,
}
