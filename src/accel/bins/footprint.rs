//! The pixels that a primitive may cover: the rectangle around its points on the film.

use super::film_point::{FilmPoint, MAX_PIXEL_ERROR};
use crate::accel::space::at_or_below;
use crate::film::PixelBounds;

/// The pixels that a primitive may cover, and a bound on its nearness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Footprint {
    /// First and last column on the film.
    pub(super) columns: [u32; 2],
    /// First and last row.
    pub(super) rows: [u32; 2],
    /// An upper bound of nearness.
    pub(super) nearness: f32,
}

/// Pixels by which rectangles are widened. Footprints in tiles have a smaller margin, so none
/// sticks out of its rectangle.
pub(super) const MARGIN: f32 = 1.0 / 256.0;
/// Covers the roundings to `f32`, relative to the distance from the film's first pixel.
pub(super) const RELATIVE_MARGIN: f32 = 1.0 / (1 << 20) as f32;
/// Exceeds the relative error of nearness in tiles.
pub(super) const NEARER: f32 = 1.0 + 1.0 / (1 << 15) as f32;

/// The part of a film that is rendered, as a view sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct FilmWindow {
    /// First and last column, first and last row.
    pixels: [[u32; 2]; 2],
    /// The same. From 2^24 on, `f32` skips integers: there the ends lie farther out.
    pub(super) ends: [[f32; 2]; 2],
    pub(super) is_perspective: bool,
}

impl FilmWindow {
    pub(super) fn new(window: &PixelBounds, is_perspective: bool) -> FilmWindow {
        let pixels = [[window.x0, window.x1 - 1], [window.y0, window.y1 - 1]];
        FilmWindow {
            pixels,
            ends: pixels.map(|[first, last]| {
                [
                    at_or_below(f64::from(first)),
                    -at_or_below(-f64::from(last)),
                ]
            }),
            is_perspective,
        }
    }

    /// The footprint of the convex hull of `points`; `None` if no ray can meet it.
    #[inline]
    pub(super) fn footprint<const N: usize>(&self, points: [FilmPoint; N]) -> Option<Footprint> {
        let (mut low, mut high) = (points[0], points[0]);
        for point in &points[1..] {
            (low, high) = (low.min(*point), high.max(*point));
        }
        let [nearest_side, farthest_side] = [low.0[3], high.0[3]];
        if nearest_side == FilmPoint::BEHIND && farthest_side == FilmPoint::BEHIND {
            return None;
        }
        let is_in_front = farthest_side == FilmPoint::FRONT;
        let is_whole = farthest_side != FilmPoint::UNKNOWN && !self.is_perspective;
        if !(is_in_front || is_whole) {
            return self.crossing(&points);
        }
        let nearness = match self.is_perspective {
            true => high.0[2] * NEARER,
            false => high.0[2],
        };
        self.between([low.0[0], low.0[1]], [high.0[0], high.0[1]], nearness)
    }

    /// The footprint of a rectangle of the film.
    #[inline]
    fn between(&self, low: [f32; 2], high: [f32; 2], nearness: f32) -> Option<Footprint> {
        let mut pixels = [[0; 2]; 2];
        for axis in 0..2 {
            let margin = MARGIN + RELATIVE_MARGIN * low[axis].abs().max(high[axis].abs());
            let [first, last] = self.ends[axis];
            // If the margin is NaN, the window's ends remain.
            let low = (low[axis] - margin).max(first);
            let high = (high[axis] + margin).min(last);
            if low > high {
                return None;
            }
            let first = next_whole(low);
            // No ray passes between two pixel centres.
            if first as f32 > high {
                return None;
            }
            let [window_first, window_last] = self.pixels[axis];
            pixels[axis] = [
                (first as u32).max(window_first),
                (high as u32).min(window_last),
            ];
        }
        let [columns, rows] = pixels;
        Some(Footprint {
            columns,
            rows,
            nearness,
        })
    }

    /// The footprint of points in a perspective that are on both sides of the eye's plane, or whose
    /// place is unknown.
    ///
    /// With film coordinates p = X / Z, everything lies to the left of column x if X - x Z < 0 for
    /// all points: if p < x for those in front of the eye, and p > x for those behind it. So the
    /// last column is the largest p in front, if it is less than any behind; and so on.
    fn crossing<const N: usize>(&self, points: &[FilmPoint; N]) -> Option<Footprint> {
        let (mut low, mut high) = ([f32::NEG_INFINITY; 2], [f32::INFINITY; 2]);
        let is_known = points.iter().all(|point| point.0[3] != FilmPoint::UNKNOWN);
        for axis in 0..2 {
            let on_side = |side: f32| {
                let points = points.iter().filter(move |point| point.0[3] == side);
                points.map(move |point| point.0[axis])
            };
            let least = |side| on_side(side).fold(f32::INFINITY, f32::min);
            let most = |side| on_side(side).fold(f32::NEG_INFINITY, f32::max);
            let far = points.iter().map(|point| point.0[axis].abs());
            let margin = 4.0 * (MAX_PIXEL_ERROR as f32 + RELATIVE_MARGIN * far.fold(0.0, f32::max));
            let (front, behind) = (FilmPoint::FRONT, FilmPoint::BEHIND);
            if is_known && most(front) + margin < least(behind) {
                high[axis] = most(front);
            }
            if is_known && least(front) - margin > most(behind) {
                low[axis] = least(front);
            }
        }
        self.between_known(low, high)
    }

    /// Like `between`, for ends that may be infinite, and something at the eye.
    fn between_known(&self, low: [f32; 2], high: [f32; 2]) -> Option<Footprint> {
        let known = |x: f32, axis: usize, end: usize| match x.is_finite() {
            true => x,
            false => self.ends[axis][end],
        };
        let low = [0, 1].map(|axis| known(low[axis], axis, 0));
        let high = [0, 1].map(|axis| known(high[axis], axis, 1));
        self.between(low, high, f32::INFINITY)
    }
}

/// The least integer not below `x`, for `x` from 0 to 2^24. The standard library's `ceil` is a
/// function call on targets without the instruction.
#[inline(always)]
fn next_whole(x: f32) -> i32 {
    let below = x as i32;
    below + i32::from((below as f32) < x)
}
