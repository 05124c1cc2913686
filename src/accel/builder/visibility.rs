//! Culls the primitives that no ray of a view can meet: they need no tree.
//!
//! A ray passes through the centre of its pixel. So a triangle whose rectangle on the film lies
//! between pixel centres is invisible, wherever it is; most triangles of a mesh finer than the film
//! are.

use crate::accel::space::AnchorSpace;
use crate::accel::view::{CameraView, MAX_PIXEL_ERROR, OnFilm};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::geometry::Bounds;
use crate::shape::Geometry;
use rayon::prelude::*;

/// The vertices of a scene on the film, and the part of the film that is rendered.
pub(crate) struct Visibility {
    view: CameraView,
    /// First and last column, first and last row.
    window: [[f32; 2]; 2],
    vertices: Vec<OnFilm>,
}

/// Pixels: twice the largest error of a projected vertex.
const MARGIN: f32 = 2.0 * MAX_PIXEL_ERROR as f32;
/// Covers the rounding to `f32`.
const RELATIVE_MARGIN: f32 = 1.0 / (1 << 20) as f32;

impl Visibility {
    /// Projects all vertices. `None` if the view's numbers are too large or too small for bounds.
    pub(crate) fn new(
        camera: &Camera,
        window: &PixelBounds,
        geometry: &Geometry,
        space: &AnchorSpace,
    ) -> Option<Visibility> {
        let view = CameraView::new(camera, space)?;
        let vertices = geometry.vertices().par_iter().with_min_len(1 << 12);
        let vertices = vertices.map(|vertex| view.on_film(*vertex)).collect();
        let window = [[window.x0, window.x1 - 1], [window.y0, window.y1 - 1]]
            .map(|ends| ends.map(|end| end as f32));
        Some(Visibility {
            view,
            window,
            vertices,
        })
    }

    /// Tests whether a ray may meet the triangle with these vertices.
    #[inline]
    pub(super) fn may_see_triangle(&self, corners: [u32; 3]) -> bool {
        self.may_see(corners.map(|corner| self.vertices[corner as usize]))
    }

    /// Tests whether a ray may meet something in `bounds`.
    pub(crate) fn may_see_box(&self, bounds: &Bounds) -> bool {
        self.may_see(bounds.corners().map(|corner| self.view.on_film(corner)))
    }

    /// Tests whether a ray may meet something in the convex hull of these points.
    #[inline]
    fn may_see<const N: usize>(&self, points: [OnFilm; N]) -> bool {
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for point in points {
            match point {
                OnFilm::At(pixel) => {
                    for axis in 0..2 {
                        low[axis] = low[axis].min(pixel[axis]);
                        high[axis] = high[axis].max(pixel[axis]);
                    }
                }
                _ => return points.iter().any(|point| *point != OnFilm::Behind),
            }
        }
        (0..2).all(|axis| {
            let margin = MARGIN + RELATIVE_MARGIN * low[axis].abs().max(high[axis].abs());
            let [first, last] = self.window[axis];
            let (low, high) = (
                (low[axis] - margin).max(first),
                (high[axis] + margin).min(last),
            );
            low <= high && next_whole(low) <= high
        })
    }
}

/// The least integer not below `x`, for `x` from 0 to 2^24. The standard library's `ceil` is a
/// function call on targets without the instruction.
#[inline]
fn next_whole(x: f32) -> f32 {
    let below = x as i32 as f32;
    if below < x { below + 1.0 } else { below }
}

#[cfg(test)]
mod tests {
    use super::next_whole;

    #[test]
    fn next_whole_agrees_with_ceil() {
        for x in [0.0, 0.25, 1.0, 1.5, 8191.0, 8191.002, 16_777_216.0f32] {
            assert_eq!(next_whole(x), x.ceil());
        }
    }
}
