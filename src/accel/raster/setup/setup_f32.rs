//! Triangle setup in `f32`: for all triangles but very large ones, those close to the eye's plane
//! and those seen edge-on.
//!
//! Only the first corner of a triangle is far from the tile's first pixel. It is transformed in
//! `f64`; everything after that is small enough for `f32`: the first corner on the film, p,
//! relative to the tile, and the differences to the other two, d1 and d2. In a perspective, with
//! (X, Y, Z) = K (corner - eye) and (A, B, C) = K edge,
//!
//! p = (X, Y) / Z and d = (A - p_x C, B - p_y C) / (Z + C),
//!
//! in which nothing large cancels. In an orthographic view p = (X, Y) and d = (A, B).
//!
//! # Bounds
//!
//! The letters are those of the fields of [`super::projected_corners`]. Let u = 2^-24, let x stand
//! for either axis, T_r = sum_k |K_rk| max(|edge1_k|, |edge2_k|), and Z' the least depth of the
//! three corners. The setup checks that Z + 8 T_z <= 4 Z' and that Z' is far above the roundings in
//! `f64`, so depths have a relative error below 8 u. In an orthographic view all corners must be in
//! front of the eye.
//!
//! *Corners.* The error of p is P_x = 8 u |p_x|, plus the errors of `f64` and of the ray. The error
//! of A is u for its own rounding, u for the matrix and 3 u for products and sums, times T_r. With
//! the quotient and the error of p, the error of d is below 24 u D_x + P_x c, where
//! D_x = (T_x + |p_x| T_z) / Z' exceeds |d_x|, and c = T_z / Z'.
//!
//! *Edge functions* are cross products of d and the vector from p to a pixel, of which (w, h) is
//! the longest. The errors of these contribute
//! 24 u (D_x h + D_y w) + P_x (c h + D_y) + P_y (c w + D_x), the roundings of three products and
//! four sums 8 u (D_x h + D_y w). The third function is the area minus the other two. The errors of
//! all functions and of the area are below
//!
//! E = 4 (34 u (D_x h + D_y w) + P_x (c h + D_y) + P_y (c w + D_x)) + 128 u D_x D_y.
//!
//! *Nearness* is that of the first corner plus the shares that the functions have in the
//! differences to the others, none of which exceeds G = T_z / (Z Z') = c / Z. Within the triangle,
//! shares are up to 1, so the errors of the two functions that are used (a quarter of E each),
//! their roundings, and that of the area contribute less than G E / area, those of the differences
//! 64 u G, and that of the first corner 16 u / Z.
//!
//! Underflow of `f32` is covered by the tiny numbers that are added to T, to D, and to the errors
//! of `f64`.

use super::edge_planes::{EdgePlanes, Setup};
use super::edge_setup::EdgeSetup;
use super::projected_corners::{CornerDepths, ProjectedCorners, TileTriangles, U};
use crate::accel::tree::PrimitiveBlock;
use crate::accel::view::TileFrame;
use crate::simd::{F32s, Lanes, Mask};

/// The largest error of a corner in pixels. With the margin of footprints it is less than the
/// margin of nodes, so that a triangle never sticks out of its node.
const MAX_ERROR: f32 = 1.0 / (1 << 13) as f32;
/// Exceeds the relative error of any nearness in `f32`.
const NEARER: f32 = 1.0 + 1.0 / (1 << 18) as f32;

impl EdgePlanes {
    /// Sets up the triangles of a block, except those with less nearness than `cull_nearness`.
    #[inline(always)]
    pub(crate) fn set_up_f32<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        frame: &TileFrame,
        block: &PrimitiveBlock,
        cull_nearness: f32,
    ) -> Setup {
        let is_perspective = frame.view.is_perspective;
        let zero = simd.splat(0.0);
        let triangles = TileTriangles::of::<EXACT>(simd, frame, block);
        let depths = CornerDepths::of(simd, is_perspective, &triangles);
        let columns = ProjectedCorners::of(simd, frame, 0, &triangles, &depths);
        let rows = ProjectedCorners::of(simd, frame, 1, &triangles, &depths);
        let precise = simd.splat(MAX_ERROR).above(columns.error.max(rows.error));
        let DepthTest {
            nearest,
            is_behind,
            is_steady,
        } = DepthTest::of(simd, frame, &depths);
        let sound = is_steady & precise;

        let [first_column, last_column] = columns.pixels(simd);
        let [first_row, last_row] = rows.pixels(simd);
        let beside = first_column.above(last_column) | first_row.above(last_row);
        let hidden = simd.splat(cull_nearness).above(nearest);
        let culled = is_behind | (sound & (beside | hidden));
        if culled.bits() & block.triangles == block.triangles {
            return Setup {
                usable: 0,
                unresolved: 0,
            };
        }
        nearest.store(&mut self.footprints.nearest);
        let first = [first_column, first_row];
        let extent = self.put_footprints(simd, first, [last_column, last_row]);

        let setup = EdgeSetup::of(simd, &columns, &rows, depths.ratio, first, &extent);
        let mut least = simd.splat(f32::INFINITY);
        for edge in 0..3 {
            setup.edges[edge].store(&mut self.edges[edge]);
            least = least.min(setup.edges[edge].most_within::<EXACT>(simd, &extent));
        }
        setup
            .nearness::<EXACT>(simd, is_perspective, &depths)
            .store(&mut self.nearness);
        let edge_error = if EXACT { setup.error } else { zero };
        edge_error.store(&mut self.edge_error);

        let sure = setup.area.above(setup.error);
        let nearness_error = setup.nearness_error(simd, frame, &depths);
        let close = simd.splat(frame.view.tolerance * 0.9).above(nearness_error);
        let outside = (zero - edge_error).above(least);
        let settled = culled | (sound & sure & outside);
        let usable = sound & sure & close & !settled;
        Setup {
            usable: usable.bits() & block.triangles,
            unresolved: !(usable | settled).bits() & block.triangles,
        }
    }
}

/// Decisions about triangles by the depths of their corners.
struct DepthTest<S: Lanes> {
    /// An upper bound of nearness.
    nearest: S::F,
    /// Triangles that are wholly behind the eye.
    is_behind: S::M,
    /// Triangles whose depths are known well enough for the other bounds.
    is_steady: S::M,
}

impl<S: Lanes> DepthTest<S> {
    #[inline(always)]
    fn of(simd: S, frame: &TileFrame, depths: &CornerDepths<S>) -> DepthTest<S> {
        let zero = simd.splat(0.0);
        let error = (depths.first.abs() + depths.terms) * simd.splat(16.0 * U)
            + simd.splat(frame.rounding[2]);
        let is_behind = zero.above(depths.farthest + error);
        if frame.view.is_perspective {
            DepthTest {
                nearest: depths.most_inverse * simd.splat(NEARER),
                is_behind,
                is_steady: depths.is_steady(simd, frame),
            }
        } else {
            DepthTest {
                nearest: error - depths.nearest,
                is_behind,
                is_steady: (depths.nearest - error).above(zero),
            }
        }
    }
}
