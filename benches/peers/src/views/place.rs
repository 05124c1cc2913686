//! Cameras for views that are made here.

use feimos::camera::{Camera, Projection, ScreenWindow};
use feimos::geometry::{Point, Transform, Vector};

/// A perspective camera with y upwards; `fov` in degrees across the shorter side of the film.
pub(crate) fn camera(eye: Point, look: Point, fov: f64, resolution: [u32; 2]) -> Camera {
    let up = Vector::new(0.0, 1.0, 0.0);
    let camera_from_world =
        Transform::look_at(eye, look, up).expect("no view here looks straight up or down");
    let [width, height] = resolution.map(f64::from);
    Camera {
        world_from_camera: camera_from_world.inverse,
        projection: Projection::perspective(fov),
        screen_window: ScreenWindow::of_aspect(width / height),
        resolution,
    }
}
