//! Edge functions and nearness of projected triangles, in `f32`, with their error bounds.

use super::edge_planes::{Extent, PixelFunction};
use super::lane_vectors::multiply_add_f32;
use super::projected_corners::{CornerDepths, ProjectedCorners, U};
use crate::accel::view::TileFrame;
use crate::simd::{F32s, Lanes, Mask};

/// The edge functions of projected triangles.
pub(super) struct EdgeSetup<S: Lanes> {
    /// Positive inside, whatever the triangle's orientation.
    pub(super) edges: [PixelFunction<S>; 3],
    /// The sum of the edge functions: twice the area.
    pub(super) area: S::F,
    /// E: bounds the error of the edge functions and of the area.
    pub(super) error: S::F,
}

#[inline(always)]
fn cross<S: Lanes>(a: &[S::F; 2], b: &[S::F; 2]) -> S::F {
    a[0] * b[1] - a[1] * b[0]
}

impl<S: Lanes> EdgeSetup<S> {
    /// The edge functions relative to the pixels `origin`.
    #[inline(always)]
    pub(super) fn of(
        simd: S,
        columns: &ProjectedCorners<S>,
        rows: &ProjectedCorners<S>,
        ratio: S::F,
        origin: [S::F; 2],
        extent: &Extent<S>,
    ) -> EdgeSetup<S> {
        let zero = simd.splat(0.0);
        let first = [columns.first - origin[0], rows.first - origin[1]];
        let signed = cross::<S>(
            &[columns.edges[0], rows.edges[0]],
            &[columns.edges[1], rows.edges[1]],
        );
        let one = simd.splat(1.0);
        let turn = signed.above(zero).select(one, zero - one);
        let to_second = [columns.edges[0] * turn, rows.edges[0] * turn];
        let to_third = [columns.edges[1] * turn, rows.edges[1] * turn];
        let area = signed * turn;
        // The function of the second corner is 0 along the edge from the first to the third.
        let second = PixelFunction([
            cross::<S>(&to_third, &first),
            to_third[1],
            zero - to_third[0],
        ]);
        let third = PixelFunction([
            cross::<S>(&first, &to_second),
            zero - to_second[1],
            to_second[0],
        ]);
        let rest = PixelFunction([
            area - second.0[0] - third.0[0],
            zero - (second.0[1] + third.0[1]),
            zero - (second.0[2] + third.0[2]),
        ]);
        EdgeSetup {
            edges: [rest, second, third],
            area,
            error: edge_error(simd, columns, rows, ratio, &first, extent),
        }
    }

    /// Nearness, which is linear on the film.
    #[inline(always)]
    pub(super) fn nearness<const EXACT: bool>(
        &self,
        simd: S,
        is_perspective: bool,
        depths: &CornerDepths<S>,
    ) -> PixelFunction<S> {
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let per_area = one / self.area;
        let (start, scale) = if is_perspective {
            (depths.inverses[0], depths.inverses[0] * per_area)
        } else {
            (zero - depths.first, per_area)
        };
        let mut shares = [zero; 2];
        for k in 0..2 {
            shares[k] = (zero - depths.edges[k]) * depths.inverses[k + 1] * scale;
        }
        let mut sum = [start, zero, zero];
        for k in 0..3 {
            sum[k] = multiply_add_f32::<S, EXACT>(self.edges[1].0[k], shares[0], sum[k]);
            sum[k] = multiply_add_f32::<S, EXACT>(self.edges[2].0[k], shares[1], sum[k]);
        }
        PixelFunction(sum)
    }

    /// Bounds the error of nearness within a triangle; in a perspective the relative error.
    #[inline(always)]
    pub(super) fn nearness_error(
        &self,
        simd: S,
        frame: &TileFrame,
        depths: &CornerDepths<S>,
    ) -> S::F {
        let of_shares = self.error / self.area + simd.splat(64.0 * U);
        let of_ray = simd.splat(20.0 * frame.view.ray_error);
        let of_f64 = simd.splat(frame.rounding[2]);
        if frame.view.is_perspective {
            // Relative to the nearness of the farthest corner, which is the least.
            let relative = depths.farthest * depths.most_inverse;
            let of_first = simd.splat(16.0 * U) + of_f64 * depths.most_inverse + of_ray;
            (depths.ratio * of_shares + of_first) * relative
        } else {
            depths.terms * of_shares + depths.first.abs() * simd.splat(16.0 * U) + of_f64 + of_ray
        }
    }
}

/// E; `ratio` is c, and `first` the first corner relative to the origin of the functions.
#[inline(always)]
fn edge_error<S: Lanes>(
    simd: S,
    columns: &ProjectedCorners<S>,
    rows: &ProjectedCorners<S>,
    ratio: S::F,
    first: &[S::F; 2],
    extent: &Extent<S>,
) -> S::F {
    let width = extent.along(0) + first[0].abs();
    let height = extent.along(1) + first[1].abs();
    let [dx, dy] = [columns.length, rows.length];
    let moved =
        columns.first_error * (ratio * height + dy) + rows.first_error * (ratio * width + dx);
    let rounded = (dx * height + dy * width) * simd.splat(4.0 * 34.0 * U);
    rounded + moved * simd.splat(4.0) + dx * dy * simd.splat(128.0 * U)
}
