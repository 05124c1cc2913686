//! The pixels of a camera on its film.

use crate::camera::{Camera, Projection};
use crate::geometry::Matrix;
use crate::per_axis::per_axis;

/// The pixel grid on the camera's plane at depth 1, for an orthographic camera at any depth.
pub(super) struct PixelGrid {
    pub(super) is_perspective: bool,
    /// Coordinates of pixel (0, 0).
    first: [f64; 2],
    /// From one pixel to the next.
    pub(super) step: [f64; 2],
    /// The largest absolute coordinates.
    pub(super) extent: [f64; 2],
}

impl PixelGrid {
    /// `None` if no matrix projects points to the film.
    pub(super) fn of(camera: &Camera) -> Option<PixelGrid> {
        let (is_perspective, tangent) = match camera.projection {
            Projection::Perspective { tangent } => (true, tangent),
            Projection::Orthographic => (false, 1.0),
            Projection::Spherical(_) | Projection::Distorted(_) => return None,
        };
        let [width, height] = camera.resolution.map(f64::from);
        let screen = &camera.screen_window;
        let step = [
            tangent * (screen.x1 - screen.x0) / width,
            tangent * (screen.y0 - screen.y1) / height,
        ];
        let first = [
            tangent * screen.x0 + step[0] / 2.0,
            tangent * screen.y1 + step[1] / 2.0,
        ];
        let extent = [
            tangent * screen.x0.abs().max(screen.x1.abs()),
            tangent * screen.y0.abs().max(screen.y1.abs()),
        ];
        Some(PixelGrid {
            is_perspective,
            first,
            step,
            extent,
        })
    }

    /// K, see [`super::CameraView::film_from_world`].
    pub(super) fn film_from_world(&self, camera_from_world: &Matrix) -> [[f64; 3]; 3] {
        let rows = camera_from_world.rows.map(|[x, y, z, _]| [x, y, z]);
        let row = |k: usize| {
            per_axis(|axis| {
                let of_depth = if self.is_perspective {
                    self.first[k] * rows[2][axis]
                } else {
                    0.0
                };
                (rows[k][axis] - of_depth) / self.step[k]
            })
        };
        [row(0), row(1), rows[2]]
    }

    /// See [`super::CameraView::offset`].
    pub(super) fn first_pixel_from_eye(&self) -> [f64; 2] {
        [0, 1].map(|k| -self.first[k] / self.step[k])
    }

    /// See [`super::CameraView::world_from_film`].
    pub(super) fn world_from_film(&self, world_from_camera: &Matrix) -> [[f64; 3]; 3] {
        let [right, up, forward] = per_axis(|axis| world_from_camera.column(axis));
        let start = per_axis(|axis| {
            let across = self.first[0] * right[axis] + self.first[1] * up[axis];
            if self.is_perspective {
                across + forward[axis]
            } else {
                across
            }
        });
        [
            start,
            right.map(|x| x * self.step[0]),
            up.map(|x| x * self.step[1]),
        ]
    }
}
