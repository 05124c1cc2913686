//! The corners of sixteen triangles, transformed and projected in `f32`.

use super::footprint::MARGIN;
use super::lane_vectors::{row_times, row_times_f32};
use crate::accel::tree::PrimitiveBlock;
use crate::accel::view::{TILE, TileFrame, UNDERFLOW};
use crate::simd::{F32s, F64s, Lanes};

/// The unit roundoff of `f32`: u in the proofs.
pub(super) const U: f32 = 1.0 / (1 << 24) as f32;
/// In a perspective, smaller depths are too close to the eye's plane for `f32`.
pub(super) const LEAST_DEPTH: f32 = 1.0 / (1u64 << 40) as f32;
/// A depth that exceeds its error in `f64` by this factor has an error below a unit in the last
/// place of `f32`.
const SURE_DEPTH: f32 = (1 << 25) as f32;

/// Triangles in tile space.
pub(super) struct TileTriangles<S: Lanes> {
    /// (X, Y, Z): the first corners.
    pub(super) first: [S::F; 3],
    /// (A, B, C): the vectors from there to the other two.
    pub(super) edges: [[S::F; 3]; 2],
    /// T: exceeds the absolute terms of the edges.
    pub(super) terms: [S::F; 3],
}

impl<S: Lanes> TileTriangles<S> {
    #[inline(always)]
    pub(super) fn of<const EXACT: bool>(
        simd: S,
        frame: &TileFrame,
        block: &PrimitiveBlock,
    ) -> TileTriangles<S> {
        let eye = frame.eye();
        let (zero, tiny) = (simd.splat(0.0), simd.splat(f32::MIN_POSITIVE));
        let mut from_eye = [simd.splat_wide(0.0); 3];
        let mut edges = [[zero; 3]; 2];
        let mut longer = [zero; 3];
        for axis in 0..3 {
            from_eye[axis] = simd.load_wide(&block.corner[axis]) - simd.splat_wide(eye[axis]);
            edges[0][axis] = simd.load(&block.edges[0][axis]);
            edges[1][axis] = simd.load(&block.edges[1][axis]);
            longer[axis] = edges[0][axis].abs().max(edges[1][axis].abs()) + tiny;
        }
        let mut in_tile = TileTriangles {
            first: [zero; 3],
            edges: [[zero; 3]; 2],
            terms: [zero; 3],
        };
        for k in 0..3 {
            let mut corner = row_times::<S, EXACT>(simd, &frame.tile_from_world[k], &from_eye);
            if k < 2 && !frame.view.is_perspective {
                corner = corner + simd.splat_wide(frame.offset[k]);
            }
            let row = &frame.tile_from_world_f32[k];
            in_tile.first[k] = corner.narrow();
            in_tile.edges[0][k] = row_times_f32::<S, EXACT>(simd, row, &edges[0]);
            in_tile.edges[1][k] = row_times_f32::<S, EXACT>(simd, row, &edges[1]);
            in_tile.terms[k] = row_times_f32::<S, EXACT>(simd, &frame.magnitudes[k], &longer);
        }
        in_tile
    }
}

/// The depths of the corners.
pub(super) struct CornerDepths<S: Lanes> {
    /// Z: the depths of the first corners.
    pub(super) first: S::F,
    /// C: the differences to the depths of the other two.
    pub(super) edges: [S::F; 2],
    /// T_z.
    pub(super) terms: S::F,
    /// Z' in a perspective: the least depth of the three.
    pub(super) nearest: S::F,
    pub(super) farthest: S::F,
    /// In a perspective the reciprocals of the three depths, otherwise 1.
    pub(super) inverses: [S::F; 3],
    /// 1 / Z', otherwise 1.
    pub(super) most_inverse: S::F,
    /// c = T_z / Z', otherwise 0.
    pub(super) ratio: S::F,
}

impl<S: Lanes> CornerDepths<S> {
    #[inline(always)]
    pub(super) fn of(
        simd: S,
        is_perspective: bool,
        triangles: &TileTriangles<S>,
    ) -> CornerDepths<S> {
        let one = simd.splat(1.0);
        let (first, terms) = (triangles.first[2], triangles.terms[2]);
        let edges = [triangles.edges[0][2], triangles.edges[1][2]];
        let others = [first + edges[0], first + edges[1]];
        let mut depths = CornerDepths {
            first,
            edges,
            terms,
            nearest: first.min(others[0]).min(others[1]),
            farthest: first.max(others[0]).max(others[1]),
            inverses: [one; 3],
            most_inverse: one,
            ratio: simd.splat(0.0),
        };
        if is_perspective {
            let inverses = [one / first, one / others[0], one / others[1]];
            depths.inverses = inverses;
            depths.most_inverse = inverses[0].max(inverses[1]).max(inverses[2]);
            depths.ratio = terms * depths.most_inverse;
        }
        depths
    }

    /// In a perspective, tests whether all corners are so far in front of the eye that depths have
    /// a small relative error.
    #[inline(always)]
    pub(super) fn is_steady(&self, simd: S, frame: &TileFrame) -> S::M {
        let allowed = self.nearest * simd.splat(4.0);
        let least = simd.splat(LEAST_DEPTH.max(frame.rounding[2] * SURE_DEPTH));
        allowed.above(self.first + self.terms * simd.splat(8.0)) & self.nearest.above(least)
    }
}

/// The corners on the film along one axis, in pixels from the tile's first.
pub(super) struct ProjectedCorners<S: Lanes> {
    /// p: the first corners.
    pub(super) first: S::F,
    /// d1, d2: the differences to the other two.
    pub(super) edges: [S::F; 2],
    /// P: bounds the error of p.
    pub(super) first_error: S::F,
    /// D: exceeds the absolute values of d1 and d2.
    pub(super) length: S::F,
    /// Bounds the error of all corners.
    pub(super) error: S::F,
}

impl<S: Lanes> ProjectedCorners<S> {
    #[inline(always)]
    pub(super) fn of(
        simd: S,
        frame: &TileFrame,
        axis: usize,
        triangles: &TileTriangles<S>,
        depths: &CornerDepths<S>,
    ) -> ProjectedCorners<S> {
        let tiny = simd.splat(UNDERFLOW);
        let rounding = simd.splat(frame.rounding[axis]);
        let of_ray = simd.splat(20.0 * frame.view.ray_error);
        let (corner, terms) = (triangles.first[axis], triangles.terms[axis]);
        let along = [triangles.edges[0][axis], triangles.edges[1][axis]];
        let (first, edges, length, of_f64) = if frame.view.is_perspective {
            let first = corner * depths.inverses[0];
            let mut edges = along;
            for k in 0..2 {
                edges[k] = (along[k] - first * depths.edges[k]) * depths.inverses[k + 1];
            }
            let length = (terms + first.abs() * depths.terms) * depths.most_inverse + tiny;
            let of_depth = first.abs() * simd.splat(frame.rounding[2]);
            (
                first,
                edges,
                length,
                (rounding + of_depth) * depths.inverses[0],
            )
        } else {
            (corner, along, terms + tiny, rounding)
        };
        let first_error = first.abs() * simd.splat(8.0 * U) + of_f64 + of_ray;
        let error = length * simd.splat(32.0 * U) + first_error * (simd.splat(1.0) + depths.ratio);
        ProjectedCorners {
            first,
            edges,
            first_error,
            length,
            error,
        }
    }

    /// The first and the last pixel of the footprint on this axis, within the tile.
    #[inline(always)]
    pub(super) fn pixels(&self, simd: S) -> [S::F; 2] {
        let (zero, margin) = (simd.splat(0.0), self.error + simd.splat(MARGIN));
        let low = self.first + zero.min(self.edges[0]).min(self.edges[1]);
        let high = self.first + zero.max(self.edges[0]).max(self.edges[1]);
        [
            (low - margin).ceil().max(zero),
            (high + margin).floor().min(simd.splat(TILE as f32 - 1.0)),
        ]
    }
}
