//! Which primitives some ray of a view may meet: only those need a tree.
//!
//! A ray passes one point of a pixel, so that a triangle whose rectangle on the film lies between the centres of pixels is seen
//! by none, wherever it is; of a mesh finer than the film most are like that.

use crate::accel::space::AnchorSpace;
use crate::accel::view::{MAX_PIXEL_ERROR, OnFilm, View};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::geometry::Bounds;
use crate::shape::Geometry;
use rayon::prelude::*;

/// Where the vertices of a scene are on the film, and the part of it that is rendered.
pub(crate) struct Visibility {
    view: View,
    /// Columns and rows, from the first to the last.
    window: [[f32; 2]; 2],
    vertices: Vec<OnFilm>,
}

/// Pixels: twice what a place on the film is off by at most.
const MARGIN: f32 = 2.0 * MAX_PIXEL_ERROR as f32;
/// For the narrowing to `f32`.
const RELATIVE_MARGIN: f32 = 1.0 / (1 << 20) as f32;

impl Visibility {
    /// `None` where the view's numbers are too large or small to tell.
    pub(crate) fn new(
        camera: &Camera,
        window: &PixelBounds,
        geometry: &Geometry,
        space: &AnchorSpace,
    ) -> Option<Visibility> {
        let view = View::new(camera, space)?;
        let vertices = geometry
            .vertices()
            .par_iter()
            .with_min_len(1 << 12)
            .map(|vertex| view.on_film(*vertex))
            .collect();
        let window = [[window.x0, window.x1 - 1], [window.y0, window.y1 - 1]]
            .map(|ends| ends.map(|end| end as f32));
        Some(Visibility {
            view,
            window,
            vertices,
        })
    }

    /// Whether a ray may meet the triangle with these corners.
    #[inline]
    pub(super) fn may_see_triangle(&self, corners: [u32; 3]) -> bool {
        self.may_see(corners.map(|corner| self.vertices[corner as usize]))
    }

    /// Whether a ray may meet something in `bounds`.
    pub(crate) fn may_see_box(&self, bounds: &Bounds) -> bool {
        self.may_see(bounds.corners().map(|corner| self.view.on_film(corner)))
    }

    /// Whether a ray may meet something between these points.
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

/// The least whole number from `x` on, which is not below 0 and at most 2^24. Without the standard library's `ceil`: where the
/// instruction is not known to be there, that is a call.
#[inline]
fn next_whole(x: f32) -> f32 {
    let below = x as i32 as f32;
    if below < x { below + 1.0 } else { below }
}

#[cfg(test)]
mod tests {
    use super::next_whole;

    #[test]
    fn whole_numbers_stay_and_others_go_up() {
        for x in [0.0, 0.25, 1.0, 1.5, 8191.0, 8191.002, 16_777_216.0f32] {
            assert_eq!(next_whole(x), x.ceil());
        }
    }
}
