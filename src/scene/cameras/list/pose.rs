//! A camera of a list: where it stands, and what it sees through.

use super::intrinsics::Intrinsics;
use crate::camera::{Camera, Projection};
use crate::error::{Error, Result};
use crate::geometry::Matrix;
use crate::scene::{Film, Scene};

/// One camera of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    pub(super) name: String,
    /// From camera space, y upwards and z along the view, as in scenes.
    pub(super) world_from_camera: Matrix,
    pub(super) lens: Lens,
}

/// Where the film and the field of view come from.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Lens {
    /// The scene's; `fov`, in degrees, overrides its field of view.
    OfScene { fov: Option<f64> },
    /// A calibrated camera's.
    Calibrated(Intrinsics),
}

impl Pose {
    /// The name of the camera: unique in the list, and valid in a file name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The camera and its film in `scene`.
    pub fn place(&self, scene: &Scene) -> (Camera, Film) {
        match &self.lens {
            Lens::OfScene { fov } => {
                let projection = fov.map_or(scene.camera.projection, Projection::perspective);
                let camera = Camera {
                    world_from_camera: self.world_from_camera,
                    projection,
                    ..scene.camera.clone()
                };
                (camera, scene.film.clone())
            }
            Lens::Calibrated(intrinsics) => {
                let film = intrinsics.film(&scene.film);
                let camera = intrinsics.camera(self.world_from_camera, film.resolution);
                (camera, film)
            }
        }
    }

    /// Puts this camera, and its film, in the place of the scene's. The history of transforms ends:
    /// it leads to another camera.
    pub fn replace_camera(&self, scene: &mut Scene) {
        (scene.camera, scene.film) = self.place(scene);
        scene.transform_history = None;
    }

    /// Whether the camera has a resolution of its own.
    pub fn has_resolution(&self) -> bool {
        match &self.lens {
            Lens::OfScene { .. } => false,
            Lens::Calibrated(intrinsics) => intrinsics.has_resolution(),
        }
    }

    /// # Errors
    /// There is a `resolution` on the command line, and the camera has one of its own.
    pub fn check_resolution(&self, resolution: Option<[u32; 2]>) -> Result<()> {
        if resolution.is_none() || !self.has_resolution() {
            return Ok(());
        }
        let name = self.name();
        let message = format!("--resolution contradicts the resolution of camera `{name}`");
        Err(Error::usage(message).note("leave out --resolution: `K` fits one size of image"))
    }
}
