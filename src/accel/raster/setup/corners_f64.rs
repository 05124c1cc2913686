//! The corners of sixteen triangles in tile space, in `f64`, and the pixels that they may cover.
//!
//! # Errors of corners
//!
//! With row r of the tile's matrix K: a corner relative to the eye has the error of one rounding;
//! the other two corners also that of their edges, 2^-53 |e|; products and sums add up to five
//! roundings of their absolute terms. [`CornersF64::error`] is sum_k |K_rk| (2^-52 e_k + 2^-48
//! (|p_k| + e_k)) plus [`UNDERFLOW`], where e_k is the longer edge.

use super::footprint::MARGIN;
use super::lane_vectors::row_times;
use crate::accel::view::{ROUNDING, TILE, TileFrame, UNDERFLOW};
use crate::shape::Triangle;
use crate::simd::{F32s, F64s, LANES, Lanes, Mask};

/// Sixteen triangles in world space.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(crate) struct TrianglesF64 {
    /// Coordinates of the first corners.
    pub(crate) corner: [[f64; LANES]; 3],
    /// Components of the vectors from the first to the second corners, and to the third.
    pub(crate) edges: [[[f64; LANES]; 3]; 2],
}

impl TrianglesF64 {
    pub(crate) fn new() -> TrianglesF64 {
        TrianglesF64 {
            corner: [[0.0; LANES]; 3],
            edges: [[[0.0; LANES]; 3]; 2],
        }
    }

    /// The first corners relative to the eye, and the edges.
    #[inline(always)]
    pub(crate) fn relative_to_eye<S: Lanes>(
        &self,
        simd: S,
        frame: &TileFrame,
    ) -> ([S::D; 3], [[S::D; 3]; 2]) {
        let eye = frame.eye();
        let mut corner = [simd.splat_wide(0.0); 3];
        let mut edges = [corner; 2];
        for axis in 0..3 {
            corner[axis] = simd.load_wide(&self.corner[axis]) - simd.splat_wide(eye[axis]);
            edges[0][axis] = simd.load_wide(&self.edges[0][axis]);
            edges[1][axis] = simd.load_wide(&self.edges[1][axis]);
        }
        (corner, edges)
    }

    /// Stores a triangle in a lane.
    #[inline(always)]
    pub(crate) fn put(&mut self, lane: usize, triangle: &Triangle) {
        let [a, b, c] = &triangle.0;
        for axis in 0..3 {
            self.corner[axis][lane] = a[axis];
            self.edges[0][axis][lane] = b[axis] - a[axis];
            self.edges[1][axis][lane] = c[axis] - a[axis];
        }
    }
}

/// The first corners and the edges of triangles in tile space: in a perspective pixels times depth,
/// and depth; in an orthographic view pixels, and depth.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CornersF64<S: Lanes> {
    pub(super) corner: [S::D; 3],
    pub(super) edges: [[S::D; 3]; 2],
    /// Bounds the errors of all corners, by component.
    pub(super) error: [S::F; 3],
    /// The part of them that the rounding of edges causes, in world space.
    pub(super) edge_error: [S::F; 3],
    /// All the rest of them.
    pub(super) rounding: [S::F; 3],
}

/// Bounds the error of edges, relative to their length.
const EDGE_ROUNDING: f32 = 1.0 / (1u64 << 52) as f32;

impl<S: Lanes> CornersF64<S> {
    /// Transforms triangles from world space to tile space.
    #[inline(always)]
    pub(crate) fn of<const EXACT: bool>(
        simd: S,
        frame: &TileFrame,
        triangles: &TrianglesF64,
    ) -> CornersF64<S> {
        let (from_eye, edges) = triangles.relative_to_eye(simd, frame);
        let zero = [simd.splat(0.0); 3];
        let mut corners = CornersF64 {
            corner: from_eye,
            edges,
            error: zero,
            edge_error: zero,
            rounding: zero,
        };
        for k in 0..3 {
            let row = &frame.tile_from_world[k];
            corners.corner[k] = row_times::<S, EXACT>(simd, row, &from_eye);
            corners.edges[0][k] = row_times::<S, EXACT>(simd, row, &edges[0]);
            corners.edges[1][k] = row_times::<S, EXACT>(simd, row, &edges[1]);
            if k < 2 && !frame.view.is_perspective {
                corners.corner[k] = corners.corner[k] + simd.splat_wide(frame.offset[k]);
            }
        }
        corners.bound_errors(simd, frame, &from_eye, &edges);
        corners
    }

    #[inline(always)]
    fn bound_errors(
        &mut self,
        simd: S,
        frame: &TileFrame,
        from_eye: &[S::D; 3],
        edges: &[[S::D; 3]; 2],
    ) {
        let mut terms = [simd.splat(0.0); 3];
        for axis in 0..3 {
            let to_second = edges[0][axis].narrow().abs();
            let edge = to_second.max(edges[1][axis].narrow().abs());
            // The least normal number stands for what is too small for f32.
            self.edge_error[axis] =
                edge * simd.splat(EDGE_ROUNDING) + simd.splat(f32::MIN_POSITIVE);
            terms[axis] = from_eye[axis].narrow().abs() + edge;
        }
        let unit = simd.splat(ROUNDING as f32);
        for k in 0..3 {
            for axis in 0..3 {
                let entry = simd.splat((frame.tile_from_world[k][axis].abs() * 1.0001) as f32);
                self.error[k] = self.error[k] + entry * self.edge_error[axis];
                self.rounding[k] = self.rounding[k] + entry * terms[axis];
            }
            self.rounding[k] = self.rounding[k] * unit + simd.splat(UNDERFLOW);
            self.error[k] = self.error[k] + self.rounding[k];
        }
    }

    /// Component `k` of all three corners.
    #[inline(always)]
    fn component(&self, k: usize) -> [S::F; 3] {
        let first = self.corner[k].narrow();
        [
            first,
            first + self.edges[0][k].narrow(),
            first + self.edges[1][k].narrow(),
        ]
    }
}

/// The pixels of a tile that triangles may cover.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coverage<S: Lanes> {
    /// First and last column, within the tile; empty if the first is behind the last.
    pub(super) columns: [S::F; 2],
    /// First and last row.
    pub(super) rows: [S::F; 2],
    /// An upper bound of nearness.
    pub(super) nearest: S::F,
    /// Triangles that are at least partly in front of the eye and may cover a pixel.
    pub(super) covers: S::M,
    /// Triangles that are wholly in front of the eye.
    pub(super) in_front: S::M,
}

#[inline(always)]
fn least<F: F32s>([a, b, c]: [F; 3]) -> F {
    a.min(b).min(c)
}

#[inline(always)]
fn most<F: F32s>([a, b, c]: [F; 3]) -> F {
    a.max(b).max(c)
}

/// Exceeds the rounding errors of a few operations in `f32`, relative to their terms.
const RELATIVE_MARGIN: f32 = 1.0 / (1 << 20) as f32;

impl<S: Lanes> Coverage<S> {
    #[inline(always)]
    pub(crate) fn of(simd: S, frame: &TileFrame, corners: &CornersF64<S>) -> Coverage<S> {
        let is_perspective = frame.view.is_perspective;
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let depth = corners.component(2);
        let (nearest, farthest) = (least(depth), most(depth));
        let depth_error = corners.error[2] * simd.splat(2.0)
            + nearest.abs().max(farthest.abs()) * simd.splat(RELATIVE_MARGIN);
        let in_front = (nearest - depth_error).above(zero);
        let is_visible = (farthest + depth_error).above(zero);
        let mut inverse = [one; 3];
        let mut nearness = depth_error - nearest;
        if is_perspective {
            inverse = [one / depth[0], one / depth[1], one / depth[2]];
            let larger = simd.splat(1.0 + 1.0 / (1 << 18) as f32);
            let infinity = simd.splat(f32::INFINITY);
            nearness = in_front.select(larger / (nearest - depth_error), infinity);
        }
        let mut ends = [[zero; 2]; 2];
        let last_pixel = simd.splat(TILE as f32 - 1.0);
        for axis in 0..2 {
            let [first, last] = pixels_along(simd, corners, axis, &inverse);
            ends[axis] = if is_perspective {
                [
                    in_front.select(first, zero),
                    in_front.select(last, last_pixel),
                ]
            } else {
                [first, last]
            };
        }
        let [columns, rows] = ends;
        let covers = is_visible & !columns[0].above(columns[1]) & !rows[0].above(rows[1]);
        Coverage {
            columns,
            rows,
            nearest: nearness,
            covers,
            in_front,
        }
    }
}

/// The first and the last pixel along an axis, given the reciprocals of the corners' depths.
#[inline(always)]
fn pixels_along<S: Lanes>(
    simd: S,
    corners: &CornersF64<S>,
    axis: usize,
    inverse: &[S::F; 3],
) -> [S::F; 2] {
    let relative = simd.splat(RELATIVE_MARGIN);
    let film = corners.component(axis);
    let pixels = [
        film[0] * inverse[0],
        film[1] * inverse[1],
        film[2] * inverse[2],
    ];
    let (low, high) = (least(pixels), most(pixels));
    let reach = low.abs().max(high.abs());
    let film_size = most([film[0].abs(), film[1].abs(), film[2].abs()]);
    let error =
        (corners.error[axis] + reach * corners.error[2]) * simd.splat(2.0) + film_size * relative;
    let per_pixel = most([inverse[0].abs(), inverse[1].abs(), inverse[2].abs()]);
    let margin = simd.splat(MARGIN) + error * per_pixel + reach * relative;
    [
        (low - margin).ceil().max(simd.splat(0.0)),
        (high + margin).floor().min(simd.splat(TILE as f32 - 1.0)),
    ]
}
