//! One segment of a curve against sixteen pixels at once.
//!
//! In object space, let A and B go from the eye to the ends of the axis, E = B - A, and d be the
//! direction of a ray. With n = E x A and
//!
//! p = A . d, q = E . d, m = n . d, s = d . d, M = s |E|^2 - q^2,
//! N = p q - s (A . E), T = p |E|^2 - q (A . E),
//!
//! the ray is nearest to the line of the axis at N / M along it, at t = T / M, and at the distance
//! |m| / sqrt(M) ([`Segment::exact`]). p, q and m are linear functions of the pixel, and s is a
//! quadratic one. A tangent v at A cuts away what has p (v . d) - s (A . v) below 0.
//!
//! # Bounds
//!
//! Let D, a, e and l bound the lengths of d, of A and B, of E and of a tangent, by sums of absolute
//! components. If the computed vectors are off by small parts of these, a product of k of them is
//! off by the sum of these parts times the product of the bounds. No number above has more than
//! eight of one vector in all its terms together, so all are within `relative`
//! ([`SegmentSpace`]) times the products of bounds: p within a D, m within a e D, M within e^2 D^2,
//! N within a e D^2, T within a e^2 D, and what a tangent cuts within a l D^2.

use super::curved::{Samples, TileSurface};
use super::segment_space::{SegmentSpace, dot, size};
use crate::accel::raster::depth_buffer::{COLUMNS, ROWS};
use crate::accel::view::TileFrame;
use crate::shape::Segment;
use crate::simd::{F32s, F64s, Lanes};

/// A segment as a tile in a perspective sees it.
pub(crate) struct TileSegment {
    /// p, q, m, and the products with both tangents, at the first pixel and what a column and a row
    /// add.
    linear: [[f64; 3]; 5],
    /// s: constant, x, y, x^2, x y, y^2.
    square: [f64; 6],
    /// |E|^2 and A . E.
    axis: [f64; 2],
    /// A . v and B . v for the tangents of A and of B.
    tangents: [f64; 2],
    /// Half the width where it begins, and what it grows by.
    half_width: [f64; 2],
    widest: f64,
    errors: Errors,
}

/// Bounds of errors.
struct Errors {
    m: f64,
    /// Of M, N and T.
    products: [f64; 3],
    /// Of what the tangents cut.
    cuts: [f64; 2],
    /// Of a half width, relative to the widest.
    width: f64,
}

/// The part of nearness that the errors of M and of T may be.
const PRECISE: f64 = (1 << 19) as f64;
/// Exceeds the rounding to `f32` of a place along the axis, which is from 0 to 1.
const OF_PLACE: f64 = 1.0 / (1 << 22) as f64;

impl TileSegment {
    /// `None` if the bounds do not hold for it.
    // Not compiled into the kernels: it uses no lanes.
    #[inline(never)]
    pub(crate) fn of(segment: &Segment, frame: &TileFrame) -> Option<TileSegment> {
        if !frame.view.is_perspective {
            return None;
        }
        let space = SegmentSpace::of(segment, frame)?;
        let [a, b] = &space.tips;
        let e = &space.axis;
        let n = cross(e, a);
        let [at_start, at_end] = &space.tangents;
        let linear = [a, e, &n, at_start, at_end].map(|v| space.directions.map(|d| dot(v, &d)));
        let [start, column, row] = &space.directions;
        let square = [
            dot(start, start),
            2.0 * dot(start, column),
            2.0 * dot(start, row),
            dot(column, column),
            2.0 * dot(column, row),
            dot(row, row),
        ];
        let (far, long, d) = (size(a).max(size(b)), size(e), space.direction_size);
        let relative = space.relative;
        let [first, last] = space.half_widths;
        let widest = first.max(last);
        let mut tangents = [dot(a, at_start), dot(b, at_end)];
        let mut cuts = [at_start, at_end].map(|v| relative * far * size(v) * d * d);
        // Without a tangent, what it would cut is made s, which is always above 0.
        for (k, v) in [at_start, at_end].into_iter().enumerate() {
            if size(v) == 0.0 {
                tangents[k] = [-1.0, 1.0][k];
                cuts[k] = relative * d * d;
            }
        }
        Some(TileSegment {
            linear,
            square,
            axis: [dot(e, e), dot(a, e)],
            tangents,
            half_width: [first, last - first],
            widest,
            errors: Errors {
                m: relative * far * long * d,
                products: [
                    relative * long * long * d * d,
                    relative * far * long * d * d,
                    relative * far * long * long * d,
                ],
                cuts,
                width: relative,
            },
        })
    }
}

impl TileSurface for TileSegment {
    #[inline(always)]
    fn samples<S: Lanes>(&self, simd: S, _: &TileFrame, block: usize) -> Samples<S> {
        let (zero, nothing) = (simd.splat(0.0), simd.splat_wide(0.0));
        let pixels = Pixels {
            simd,
            x: simd.load(&COLUMNS[block]).widen(),
            y: simd.load(&ROWS[block]).widen(),
        };
        let p = pixels.line(&self.linear[0]);
        let q = pixels.line(&self.linear[1]);
        let m = pixels.line(&self.linear[2]);
        let s = pixels.square(&self.square);
        let square = simd.splat_wide(self.axis[0]);
        let product = simd.splat_wide(self.axis[1]);
        let slant = s * square - q * q;
        let place = p * q - s * product;
        let ahead = p * square - q * product;
        let after_start = p * pixels.line(&self.linear[3]) - s * simd.splat_wide(self.tangents[0]);
        let before_end =
            s * simd.splat_wide(self.tangents[1]) - (p + q) * pixels.line(&self.linear[4]);

        let [of_slant, of_place, of_ahead] = self.errors.products;
        let is_slanted = exceeds(simd, slant, PRECISE * of_slant);
        let [at_start, at_end] = self.errors.cuts;
        // Where the ray passes the axis: between its ends, or at one of them.
        let along = (place / slant).narrow();
        let along = along.max(zero).min(simd.splat(1.0)).widen();
        let [first, growth] = self.half_width;
        let half_width = along.fused_or_not(simd.splat_wide(growth), simd.splat_wide(first));
        let slope = growth.abs();
        let slack = simd.splat_wide(2.0 * (of_slant + of_place) * slope) / slant
            + simd.splat_wide(slope * OF_PLACE + self.widest * self.errors.width);
        let (inner, outer) = (half_width - slack, half_width + slack);
        let least = slant - simd.splat_wide(of_slant);
        let most = slant + simd.splat_wide(of_slant);
        // m^2 is off by 2 |m| times the error of m, and its square.
        let off = simd.splat_wide(self.errors.m);
        let of_square = (m * m).sqrt() * simd.splat_wide(2.0 * self.errors.m) + off * off;
        let is_inside = (inner * inner * least - (m * m + of_square))
            .narrow()
            .above(zero)
            & inner.narrow().above(zero);
        let is_outside = (m * m - of_square - outer * outer * most)
            .narrow()
            .above(zero);

        let is_between =
            exceeds(simd, place, of_place) & exceeds(simd, slant - place, of_slant + of_place);
        let is_kept = exceeds(simd, after_start, at_start) & exceeds(simd, before_end, at_end);
        let is_cut = exceeds(simd, nothing - after_start, at_start)
            | exceeds(simd, nothing - before_end, at_end);
        let is_precise = exceeds(simd, ahead, PRECISE * of_ahead);
        // At an end, t is not that of the line.
        let is_behind = is_between & exceeds(simd, nothing - ahead, of_ahead);
        Samples {
            sure: is_slanted & is_between & is_kept & is_inside & is_precise,
            possible: !(is_slanted & (is_outside | is_cut | is_behind)),
            nearness: (slant / ahead).narrow(),
        }
    }
}

/// The coordinates of sixteen pixels.
struct Pixels<S: Lanes> {
    simd: S,
    x: S::D,
    y: S::D,
}

impl<S: Lanes> Pixels<S> {
    /// A linear function: its value at the first pixel, and what a column and a row add.
    #[inline(always)]
    fn line(&self, [start, column, row]: &[f64; 3]) -> S::D {
        let simd = self.simd;
        let in_row = simd
            .splat_wide(*column)
            .fused_or_not(self.x, simd.splat_wide(*start));
        simd.splat_wide(*row).fused_or_not(self.y, in_row)
    }

    /// A quadratic function: constant, x, y, x^2, x y, y^2.
    #[inline(always)]
    fn square(&self, [constant, x, y, xx, xy, yy]: &[f64; 6]) -> S::D {
        let simd = self.simd;
        let of_x = simd
            .splat_wide(*xx)
            .fused_or_not(self.x, simd.splat_wide(*x));
        let in_row = of_x.fused_or_not(self.x, simd.splat_wide(*constant));
        let of_y = simd
            .splat_wide(*xy)
            .fused_or_not(self.x, simd.splat_wide(*y));
        let of_y = simd.splat_wide(*yy).fused_or_not(self.y, of_y);
        of_y.fused_or_not(self.y, in_row)
    }
}

/// Where `number` exceeds `bound`.
#[inline(always)]
fn exceeds<S: Lanes>(simd: S, number: S::D, bound: f64) -> S::M {
    let beyond = (number - simd.splat_wide(bound)).narrow();
    beyond.above(simd.splat(0.0))
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
