//! Options of `pixel` as typed.

use crate::cli::args::{InputArgs, TalkArgs, pixel, resolution, threads};
use clap::Args;
use feimos::accel::SplitMethod;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct PixelArgs {
    /// The scene: a .pbrt file, `-`, or a bare .ply or .obj mesh.
    #[arg(value_name = "SCENE")]
    pub(crate) scene: PathBuf,
    /// Column and row of the pixel, counted from 0 at the upper left corner of the film.
    #[arg(value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub(crate) pixel: [u32; 2],
    /// Print one JSON object [default: a block for people].
    #[arg(long, help_heading = "Output")]
    pub(crate) json: bool,
    /// Width and height of the film [default: the scene's].
    #[arg(long, value_name = "WxH", value_parser = resolution, help_heading = "Region")]
    pub(crate) resolution: Option<[u32; 2]>,
    /// Count the cost with this accelerator alone: none, middle, equal, sah or hlbvh [default: all].
    #[arg(long, value_name = "METHOD", help_heading = "Engine")]
    pub(crate) accel: Option<SplitMethod>,
    /// Threads to use [default: all that the process may use].
    #[arg(long, alias = "nthreads", value_name = "N", value_parser = threads, help_heading = "Engine")]
    pub(crate) threads: Option<usize>,
    #[command(flatten, next_help_heading = "Input")]
    pub(crate) input: InputArgs,
    #[command(flatten, next_help_heading = "Talk")]
    pub(crate) talk: TalkArgs,
}
