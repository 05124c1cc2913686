//! A plain loader on one thread: as much of PBRT and PLY as the scenes of `picture` need.

mod cameras;
mod directives;
mod ply;
mod text;

pub(crate) use cameras::Pose;

use crate::Result;
use crate::geometry::Geometry;
use feimos::camera::Camera;
use std::path::Path;

/// A scene as peers take it.
#[derive(Debug)]
pub(super) struct Scene {
    /// Each with the name that stands for `{camera}`.
    pub(super) cameras: Vec<(String, Camera)>,
    pub(super) geometry: Geometry,
}

/// Loads a scene, with the cameras of a list instead of its own if there is one.
pub(super) fn load(scene: &Path, cameras: Option<&Path>) -> Result<Scene> {
    let (camera, geometry) = directives::read(scene)?;
    let cameras = match cameras {
        Some(list) => cameras::read(list, &camera)?,
        None => vec![(String::new(), camera)],
    };
    Ok(Scene { cameras, geometry })
}
