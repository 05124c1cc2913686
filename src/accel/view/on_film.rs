//! Projects points onto the film.

use super::camera_view::{CameraView, ROUNDING, UNDERFLOW};
use crate::geometry::Point;

/// Bounds the error of a projected point, in pixels.
pub(crate) const MAX_PIXEL_ERROR: f64 = 1.0 / 512.0;

/// The projection of a point onto the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum OnFilm {
    /// At this column and row, with an error below [`MAX_PIXEL_ERROR`] and a rounding to `f32`.
    At([f32; 2]),
    /// Behind the eye: no ray gets there.
    Behind,
    /// So close to the eye's plane that its place is unknown.
    Anywhere,
}

impl CameraView {
    /// Projects a point in world space.
    pub(crate) fn on_film(&self, point: Point) -> OnFilm {
        let from_eye = point - self.eye;
        let k = &self.film_from_world;
        let row = |row: &[f64; 3]| row[0] * from_eye.x + row[1] * from_eye.y + row[2] * from_eye.z;
        let error_of = |row: &[f64; 3]| {
            from_eye.largest() * (row[0].abs() + row[1].abs() + row[2].abs()) * ROUNDING
                + f64::from(UNDERFLOW)
        };
        let (depth, depth_error) = (row(&k[2]), error_of(&k[2]));
        if depth + depth_error < 0.0 {
            return OnFilm::Behind;
        }
        let is_clear_of_eye = depth > depth_error * 1e3;
        if self.is_perspective && !is_clear_of_eye || !point.is_finite() {
            return OnFilm::Anywhere;
        }
        let inverse = if self.is_perspective {
            1.0 / depth
        } else {
            1.0
        };
        let pixel = [0, 1].map(|axis| row(&k[axis]) * inverse + self.offset[axis]);
        // The error of depth moves a pixel in proportion to its distance from the first one.
        let error = |axis: usize| {
            (error_of(&k[axis]) + pixel[axis].abs() * depth_error) * inverse
                + self.offset[axis].abs() * ROUNDING
        };
        if error(0).max(error(1)) < MAX_PIXEL_ERROR {
            OnFilm::At(pixel.map(|coordinate| coordinate as f32))
        } else {
            OnFilm::Anywhere
        }
    }
}
