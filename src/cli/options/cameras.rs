//! Options for cameras of a list, in place of the scene's own.

use crate::error::{Error, Result};
use crate::scene::{self, Pose};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct CameraArgs {
    /// See each scene from the cameras in this file instead of its own: a list by feimos (objects
    /// with a `name` and with `lookat`, `transform`, or `K`, `R`, `t` and `resolution`), a
    /// transforms.json of NeRF programs, or a text model of COLMAP (its folder, or one of its two
    /// files). With several cameras, an output of render needs {camera} in its name
    /// [default: the scene's camera].
    #[arg(long, value_name = "FILE")]
    pub(crate) cameras: Option<PathBuf>,
    /// Take only the camera of this name; may be repeated where several cameras make sense
    /// [default: all].
    #[arg(long, value_name = "NAME", requires = "cameras")]
    pub(crate) camera: Vec<String>,
}

/// The names that a message lists.
const SHOWN: usize = 5;

impl CameraArgs {
    /// The files of the list.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let files = self.cameras.as_deref().map(scene::pose_files);
        files.unwrap_or_default()
    }

    /// The cameras that were chosen, in the order of the list; `None` for the scene's own.
    ///
    /// # Errors
    /// The list is wrong, or has no camera of a name.
    pub(crate) fn poses(&self) -> Result<Option<Vec<Pose>>> {
        let Some(path) = &self.cameras else {
            return Ok(None);
        };
        let poses = scene::read_poses(path)?;
        let is_known = |name: &&String| poses.iter().any(|pose| pose.name() == name.as_str());
        if let Some(name) = self.camera.iter().find(|name| !is_known(name)) {
            let message = format!("{} has no camera `{name}`", path.display());
            return Err(Error::usage(message).note(format!("it has {}", names_of(&poses))));
        }
        let is_chosen = |pose: &Pose| {
            self.camera.is_empty() || self.camera.iter().any(|name| name == pose.name())
        };
        Ok(Some(poses.into_iter().filter(is_chosen).collect()))
    }

    /// The one camera that was chosen; `None` for the scene's own.
    ///
    /// # Errors
    /// The list is wrong, or several cameras remain.
    pub(crate) fn pose(&self) -> Result<Option<Pose>> {
        let Some(mut poses) = self.poses()? else {
            return Ok(None);
        };
        if poses.len() > 1 {
            let message = format!("one camera is needed, and there are {}", poses.len());
            let note = format!("choose one with --camera: {}", names_of(&poses));
            return Err(Error::usage(message).note(note));
        }
        Ok(poses.pop())
    }
}

/// The first names, and how many more there are.
fn names_of(poses: &[Pose]) -> String {
    let shown: Vec<String> = poses
        .iter()
        .take(SHOWN)
        .map(|pose| format!("`{}`", pose.name()))
        .collect();
    let list = shown.join(", ");
    match poses.len().saturating_sub(SHOWN) {
        0 => list,
        more => format!("{list} and {more} more"),
    }
}
