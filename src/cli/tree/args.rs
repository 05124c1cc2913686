//! Options of `tree` as typed.

use crate::accel::SplitMethod;
use crate::cli::options::engine::ThreadArgs;
use crate::cli::options::messages::MessageArgs;
use crate::cli::options::scene::SceneArgs;
use crate::cli::options::values::{integer, named, resolution};
use crate::error::{Error, Result};
use clap::Args;
use std::ops::RangeInclusive;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct TreeArgs {
    /// The scene: a .pbrt file, `-`, or a bare mesh (.ply, .obj, .stl, .off).
    #[arg(value_name = "SCENE")]
    pub(super) scene: PathBuf,
    /// Draw the edges of the boxes over a depth picture, coloured by depth; edges behind surfaces
    /// are faint [default: no picture].
    #[arg(short, long, value_name = "FILE.png", help_heading = "Output")]
    pub(super) output: Option<PathBuf>,
    /// Write the boxes as a mesh: six quads each, with a colour by depth [default: no mesh]. Boxes
    /// hide what is within: choose one depth, or look at the mesh as a wireframe.
    #[arg(long, value_name = "FILE.ply", help_heading = "Output")]
    pub(super) ply: Option<PathBuf>,
    /// Draw the boxes of nodes at these depths, and of leaves above them: from FIRST to LAST, or at
    /// one depth. The root has depth 0 [default: 0,5].
    #[arg(long, value_name = "[FIRST,]LAST", value_parser = depths, help_heading = "Output")]
    depth: Option<RangeInclusive<usize>>,
    /// Print one JSON object [default: text].
    #[arg(long, help_heading = "Output")]
    pub(super) json: bool,
    /// Set the width and height of the picture [default: the scene's].
    #[arg(long, value_name = "WxH", value_parser = resolution, help_heading = "Region")]
    pub(super) resolution: Option<[u32; 2]>,
    /// Build the tree with this split method [default: that of the scene, else sah].
    #[arg(long, value_name = "METHOD", help_heading = "Engine")]
    #[arg(value_parser = named(SplitMethod::ALL, SplitMethod::name))]
    pub(super) accel: Option<SplitMethod>,
    /// Set the largest number of primitives in a leaf [default: the scene's maxnodeprims, else 16].
    #[arg(long, value_name = "COUNT", help_heading = "Engine")]
    #[arg(value_parser = integer(1..=u32::MAX as usize))]
    pub(super) max_leaf: Option<usize>,
    #[command(flatten, next_help_heading = "Engine")]
    pub(super) threads: ThreadArgs,
    #[command(flatten, next_help_heading = "Input")]
    pub(super) input: SceneArgs,
    #[command(flatten, next_help_heading = "Messages")]
    pub(crate) messages: MessageArgs,
}

impl TreeArgs {
    /// The depths whose boxes are drawn.
    pub(super) fn depths(&self) -> RangeInclusive<usize> {
        self.depth.clone().unwrap_or(0..=5)
    }

    /// # Errors
    /// There are depths to draw, but no file to draw them in.
    pub(super) fn check_depth(&self) -> Result<()> {
        if self.depth.is_some() && self.output.is_none() && self.ply.is_none() {
            let message = "--depth chooses the boxes of a picture or a mesh";
            return Err(Error::usage(message).note("give -o FILE.png or --ply FILE.ply"));
        }
        Ok(())
    }
}

/// No tree is deeper.
const MAX_DEPTH: usize = 96;

/// Parses one depth, or the first and the last.
fn depths(text: &str) -> std::result::Result<RangeInclusive<usize>, String> {
    let depth = |part: &str| {
        let depth = part.trim().parse().ok();
        depth.filter(|depth| *depth <= MAX_DEPTH).ok_or_else(|| {
            format!("`{part}` is not an integer from 0 to {MAX_DEPTH}, the depth of any tree")
        })
    };
    let Some((first, last)) = text.split_once(',') else {
        let depth = depth(text)?;
        return Ok(depth..=depth);
    };
    let (first, last) = (depth(first)?, depth(last)?);
    if first > last {
        return Err("expected the smaller depth first".to_owned());
    }
    Ok(first..=last)
}
