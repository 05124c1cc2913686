//! Options for the region: which pixels of which film are rendered.

use super::values::{integers, numbers, resolution};
use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct RegionArgs {
    /// Render only this part of the film: fractions of its size, y downwards, rounded as in pbrt
    /// [default: the scene's crop, else the whole film].
    #[arg(long, value_name = "X0,X1,Y0,Y1", value_parser = numbers::<4>)]
    #[arg(allow_hyphen_values = true, hide_short_help = true)]
    pub(crate) cropwindow: Option<[f64; 4]>,
    /// Render only this part of the film: pixels, upper ends exclusive [default: the scene's crop,
    /// else the whole film].
    #[arg(long, value_name = "X0,X1,Y0,Y1", value_parser = integers::<4>)]
    #[arg(allow_hyphen_values = true, conflicts_with = "cropwindow")]
    pub(crate) pixelbounds: Option<[u32; 4]>,
    /// Set the width and height of the film [default: the scene's].
    #[arg(long, value_name = "WxH", value_parser = resolution, allow_hyphen_values = true)]
    pub(crate) resolution: Option<[u32; 2]>,
}
