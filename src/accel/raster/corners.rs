//! Sixteen triangles in the space of a tile: where their corners are, and which pixels they may cover.
//!
//! # How far a corner may be off
//!
//! With row r of the tile's matrix K: a corner relative to the eye is off by one rounding; the other two corners
//! besides by the rounding of their edges, 2^-53 |e|; products and sums by at most five more roundings of their
//! absolute terms. [`Corners::error`] is sum_k |K_rk| (2^-52 e_k + 2^-48 (|p_k| + e_k)), e_k the longer edge, and
//! [`UNDERFLOW`].

use super::frame::{Frame, MARGIN, TILE};
use super::view::{ROUNDING, UNDERFLOW};
use crate::shape::Triangle;
use crate::simd::{F32s, F64s, LANES, Lanes, Mask};

/// A triangle's first corner and its edges in the space of the tile. In a perspective: pixels times depth, and depth. In an
/// orthographic view: pixels, and depth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corners<S: Lanes> {
    pub(super) corner: [S::D; 3],
    pub(super) edges: [[S::D; 3]; 2],
    /// Bounds on the errors of all corners, by component.
    pub(super) error: [S::F; 3],
    /// What of them is due to the rounding of edges, in world space.
    pub(super) edge_error: [S::F; 3],
    /// All the rest of them.
    pub(super) rounding: [S::F; 3],
}

/// What edges are off by, relative to their length.
const EDGE_ROUNDING: f32 = 1.0 / (1u64 << 52) as f32;

/// Sixteen triangles in world space.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct WideTriangles {
    /// Coordinates of the first corners.
    pub(super) corner: [[f64; LANES]; 3],
    /// Components of the vectors from the first to the second corners, and to the third.
    pub(super) edges: [[[f64; LANES]; 3]; 2],
}

impl WideTriangles {
    pub(super) fn new() -> WideTriangles {
        WideTriangles {
            corner: [[0.0; LANES]; 3],
            edges: [[[0.0; LANES]; 3]; 2],
        }
    }

    /// The first corners relative to the eye, and the edges.
    #[inline(always)]
    pub(super) fn relative_to_eye<S: Lanes>(
        &self,
        simd: S,
        frame: &Frame,
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

    /// Puts a triangle into a lane.
    #[inline(always)]
    pub(super) fn put(&mut self, lane: usize, triangle: &Triangle) {
        let [a, b, c] = &triangle.0;
        for axis in 0..3 {
            self.corner[axis][lane] = a[axis];
            self.edges[0][axis][lane] = b[axis] - a[axis];
            self.edges[1][axis][lane] = c[axis] - a[axis];
        }
    }
}

/// The product and sum that is right for the precision: what is compared by its bits, at whatever level, is never fused.
#[inline(always)]
pub(super) fn multiply_add<S: Lanes, const EXACT: bool>(a: S::D, b: S::D, c: S::D) -> S::D {
    if EXACT {
        a.fused_or_not(b, c)
    } else {
        a * b + c
    }
}

#[inline(always)]
pub(super) fn dot<S: Lanes, const EXACT: bool>(a: &[S::D; 3], b: &[S::D; 3]) -> S::D {
    let sum = multiply_add::<S, EXACT>(a[1], b[1], a[0] * b[0]);
    multiply_add::<S, EXACT>(a[2], b[2], sum)
}

/// The dot product with one vector for all lanes.
#[inline(always)]
pub(super) fn row_times<S: Lanes, const EXACT: bool>(
    simd: S,
    row: &[f64; 3],
    v: &[S::D; 3],
) -> S::D {
    dot::<S, EXACT>(
        &[
            simd.splat_wide(row[0]),
            simd.splat_wide(row[1]),
            simd.splat_wide(row[2]),
        ],
        v,
    )
}

#[inline(always)]
pub(super) fn cross<S: Lanes, const EXACT: bool>(
    a: &[S::D; 3],
    b: &[S::D; 3],
    zero: S::D,
) -> [S::D; 3] {
    let mut product = *a;
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        // The second product negated, so that the first may be fused.
        product[k] = multiply_add::<S, EXACT>(a[i], b[j], zero - a[j] * b[i]);
    }
    product
}

impl<S: Lanes> Corners<S> {
    /// Of first corners and edges, in world space.
    #[inline(always)]
    pub(super) fn of<const EXACT: bool>(
        simd: S,
        frame: &Frame,
        triangles: &WideTriangles,
    ) -> Corners<S> {
        let (from_eye, edges) = triangles.relative_to_eye(simd, frame);
        let zero = simd.splat(0.0);
        let none = [zero; 3];
        let mut corners = Corners {
            corner: from_eye,
            edges,
            error: none,
            edge_error: none,
            rounding: none,
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
        let mut terms = none;
        for axis in 0..3 {
            let edge = edges[0][axis]
                .narrow()
                .abs()
                .max(edges[1][axis].narrow().abs());
            // The least number for what is too small for f32.
            corners.edge_error[axis] =
                edge * simd.splat(EDGE_ROUNDING) + simd.splat(f32::MIN_POSITIVE);
            terms[axis] = from_eye[axis].narrow().abs() + edge;
        }
        let unit = simd.splat(ROUNDING as f32);
        for k in 0..3 {
            for axis in 0..3 {
                let entry = simd.splat((frame.tile_from_world[k][axis].abs() * 1.0001) as f32);
                corners.error[k] = corners.error[k] + entry * corners.edge_error[axis];
                corners.rounding[k] = corners.rounding[k] + entry * terms[axis];
            }
            corners.rounding[k] = corners.rounding[k] * unit + simd.splat(UNDERFLOW);
            corners.error[k] = corners.error[k] + corners.rounding[k];
        }
        corners
    }

    /// Component `k` of all three corners.
    #[inline(always)]
    pub(super) fn component(&self, k: usize) -> [S::F; 3] {
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
pub(super) struct Cover<S: Lanes> {
    /// First and last column, first and last row: within the tile, and empty where the first is behind the last.
    pub(super) columns: [S::F; 2],
    pub(super) rows: [S::F; 2],
    /// No point of the triangle is nearer.
    pub(super) nearness: S::F,
    /// Triangles that are in front of the eye, at least in part, and may cover a pixel.
    pub(super) covers: S::M,
    /// Triangles that are wholly in front of it.
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

impl<S: Lanes> Cover<S> {
    #[inline(always)]
    pub(super) fn of(simd: S, frame: &Frame, corners: &Corners<S>) -> Cover<S> {
        let is_perspective = frame.view.is_perspective;
        let (zero, one, infinity) = (simd.splat(0.0), simd.splat(1.0), simd.splat(f32::INFINITY));
        let relative = simd.splat(1.0 / (1 << 20) as f32);
        let depth = corners.component(2);
        let (nearest, farthest) = (least(depth), most(depth));
        let depth_error =
            corners.error[2] * simd.splat(2.0) + nearest.abs().max(farthest.abs()) * relative;
        let in_front = (nearest - depth_error).above(zero);
        let visible = (farthest + depth_error).above(zero);
        let inverse = if is_perspective {
            [one / depth[0], one / depth[1], one / depth[2]]
        } else {
            [one; 3]
        };
        let nearness = if is_perspective {
            in_front.select(
                simd.splat(1.0 + 1.0 / (1 << 18) as f32) / (nearest - depth_error),
                infinity,
            )
        } else {
            depth_error - nearest
        };
        let mut ends = [[zero; 2]; 2];
        let whole = simd.splat(TILE as f32 - 1.0);
        for k in 0..2 {
            let film = corners.component(k);
            let pixels = [
                film[0] * inverse[0],
                film[1] * inverse[1],
                film[2] * inverse[2],
            ];
            let (low, high) = (least(pixels), most(pixels));
            let reach = low.abs().max(high.abs());
            let film_size = most([film[0].abs(), film[1].abs(), film[2].abs()]);
            let error = (corners.error[k] + reach * corners.error[2]) * simd.splat(2.0)
                + film_size * relative;
            let per_pixel = most([inverse[0].abs(), inverse[1].abs(), inverse[2].abs()]);
            let margin = simd.splat(MARGIN) + error * per_pixel + reach * relative;
            let first = (low - margin).ceil().max(zero);
            let last = (high + margin).floor().min(whole);
            ends[k] = if is_perspective {
                [in_front.select(first, zero), in_front.select(last, whole)]
            } else {
                [first, last]
            };
        }
        let [columns, rows] = ends;
        let covers = visible & !columns[0].above(columns[1]) & !rows[0].above(rows[1]);
        Cover {
            columns,
            rows,
            nearness,
            covers,
            in_front,
        }
    }
}
