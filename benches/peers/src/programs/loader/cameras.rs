//! Lists of cameras: poses by `lookat` only.

use crate::Result;
use feimos::camera::Camera;
use feimos::geometry::{Point, Transform, Vector};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// One camera of a list, with the film and lens of the scene.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Pose {
    pub(crate) name: String,
    /// The eye, a point to look at, the up direction.
    pub(crate) lookat: [f64; 9],
}

/// Reads a list; everything but the pose is that of `camera`.
pub(super) fn read(list: &Path, camera: &Camera) -> Result<Vec<(String, Camera)>> {
    let poses: Vec<Pose> = serde_json::from_slice(&std::fs::read(list)?)?;
    let place = |pose: Pose| {
        let camera_from_world = look_at(pose.lookat)?;
        let world_from_camera = camera_from_world.inverse;
        let camera = Camera {
            world_from_camera,
            ..camera.clone()
        };
        Ok((pose.name, camera))
    };
    poses.into_iter().map(place).collect()
}

/// `LookAt` with its nine numbers.
pub(super) fn look_at(numbers: [f64; 9]) -> Result<Transform> {
    let [ex, ey, ez, lx, ly, lz, ux, uy, uz] = numbers;
    let (eye, look) = (Point::new(ex, ey, ez), Point::new(lx, ly, lz));
    let transform = Transform::look_at(eye, look, Vector::new(ux, uy, uz));
    transform.ok_or_else(|| "a LookAt along its own up direction".into())
}
