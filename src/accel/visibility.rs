//! Which primitives some ray of a view may meet: only those need a tree.
//!
//! A ray passes one point of a pixel, so that a triangle whose rectangle on the film lies between the centres of pixels is seen
//! by none, wherever it is; of a mesh finer than the film most are like that.

use super::anchor_space::AnchorSpace;
use super::tile::View;
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::geometry::{Bounds, Point};
use crate::shape::Shapes;
use rayon::prelude::*;

/// Where the vertices of a scene are on the film, and the part of it that is rendered.
pub(super) struct Visibility {
    view: View,
    /// Columns and rows, from the first to the last.
    window: [[f32; 2]; 2],
    vertices: Vec<OnFilm>,
}

/// A point on the film.
#[derive(Debug, Clone, Copy, PartialEq)]
enum OnFilm {
    /// Column and row, off by less than [`MARGIN`] and [`RELATIVE_MARGIN`] of themselves.
    At([f32; 2]),
    /// Behind the eye: no ray gets there.
    Behind,
    /// So close to the eye's plane that it may be anywhere.
    Anywhere,
}

/// Pixels.
const MARGIN: f32 = 1.0 / 256.0;
const RELATIVE_MARGIN: f32 = 1.0 / (1 << 20) as f32;
/// What products and sums of three terms are off by, relative to the sum of their absolute terms: ample.
const ROUNDING: f64 = 1.0 / (1u64 << 48) as f64;

impl Visibility {
    /// `None` where the view's numbers are too large or small to tell.
    pub(super) fn new(
        camera: &Camera,
        window: &PixelBounds,
        shapes: &Shapes,
        space: &AnchorSpace,
    ) -> Option<Visibility> {
        let view = View::new(camera, space)?;
        let vertices =
            shapes.vertices().par_iter().with_min_len(1 << 12).map(|vertex| on_film(&view, *vertex)).collect();
        let window = [[window.x0, window.x1 - 1], [window.y0, window.y1 - 1]].map(|ends| ends.map(|end| end as f32));
        Some(Visibility { view, window, vertices })
    }

    /// Whether a ray may meet the triangle with these corners.
    #[inline]
    pub(super) fn may_see_triangle(&self, corners: [u32; 3]) -> bool {
        self.may_see(corners.map(|corner| self.vertices[corner as usize]))
    }

    /// Whether a ray may meet something in `bounds`.
    pub(super) fn may_see_box(&self, bounds: &Bounds) -> bool {
        let corner = |k: usize| {
            let end = |axis: usize| if k >> axis & 1 == 0 { bounds.low[axis] } else { bounds.high[axis] };
            on_film(&self.view, Point::new(end(0), end(1), end(2)))
        };
        self.may_see(std::array::from_fn::<OnFilm, 8, _>(corner))
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
            let (low, high) = ((low[axis] - margin).max(first), (high[axis] + margin).min(last));
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

fn on_film(view: &View, point: Point) -> OnFilm {
    let from_eye = point - view.eye;
    let k = &view.film_from_world;
    let row = |row: &[f64; 3]| row[0] * from_eye.x + row[1] * from_eye.y + row[2] * from_eye.z;
    let terms = |row: &[f64; 3]| from_eye.largest() * (row[0].abs() + row[1].abs() + row[2].abs()) * ROUNDING;
    let (depth, depth_error) = (row(&k[2]), terms(&k[2]));
    if depth + depth_error < 0.0 {
        return OnFilm::Behind;
    }
    let is_clear_of_eye = depth > depth_error * 1e3;
    if view.is_perspective && !is_clear_of_eye || !point.is_finite() {
        return OnFilm::Anywhere;
    }
    let inverse = if view.is_perspective { 1.0 / depth } else { 1.0 };
    let pixel = [0, 1].map(|axis| row(&k[axis]) * inverse + view.offset[axis]);
    // The error of depth moves a pixel in proportion to its distance from the first one.
    let error = |axis: usize| {
        (terms(&k[axis]) + pixel[axis].abs() * depth_error) * inverse + view.offset[axis].abs() * ROUNDING
    };
    if error(0).max(error(1)) < f64::from(MARGIN) / 2.0 {
        OnFilm::At(pixel.map(|coordinate| coordinate as f32))
    } else {
        OnFilm::Anywhere
    }
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
