//! The triangles that pixels of a tile see, and their depths as functions of the pixel.
//!
//! A ray o + t d passes the plane of a triangle with first corner v and normal n = e1 x e2, the
//! cross product of its edges, at t = n . (v - o) / n . d. In a perspective, o is the eye and d is
//! linear in the pixel, so 1/t is linear; in an orthographic view d is constant and o is linear,
//! and so is t.
//!
//! # Bounds
//!
//! The true hit is a mean of the true corners. Its distance from the computed plane, times |n|, is
//! the same mean of the corners' errors along n: no more than sum_k |n_k| s_k, where s_k bounds the
//! errors of component k. So the error of the computed t is no more than that over |n . d|, and the
//! relative error that over |n . (v - o)|, no matter how narrow the triangle is. For an edge, s is
//! 2^-24 of its larger component, or 2^-53 if it was computed in `f64`. The roundings of v - o, of
//! n and of the dot products act as if s were larger by 2^-49 (|v - o|_k + e_k), and the errors of
//! the ray by t times its own. As n is rounded, n . e is not quite 0: it is up to 2^-52 of the
//! absolute terms of n times e, 6 e_x e_y e_z.

use super::setup::{TrianglesF64, cross, dot, row_times};
use crate::accel::view::{CameraView, TileFrame};
use crate::geometry::Point;
use crate::shape::{InstancedId, PrimitiveId, Triangle};
use crate::simd::{F32s, F64s, LANES, Lanes};

/// Visible triangles in the order in which pixels first saw them, with their depth planes.
#[derive(Debug)]
pub(super) struct DepthPlanes {
    groups: Vec<PlaneGroup>,
    count: usize,
}

/// Sixteen triangles.
#[derive(Debug, Clone)]
#[repr(align(64))]
struct PlaneGroup {
    triangles: TrianglesF64,
    /// Bounds the error of edges, relative to their length.
    edge_rounding: [f32; LANES],
    primitives: [InstancedId; LANES],
    /// Nearness at the tile's first pixel, and its steps per column and row.
    nearness: [[f64; LANES]; 3],
    /// Bounds the error of depth: relative, in an orthographic view in units of depth.
    error: [f32; LANES],
}

/// Relative errors of edges that were rounded to `f32`, and of those that were computed in `f64`.
const F32_EDGE_ROUNDING: f32 = 1.0001 / (1 << 24) as f32;
const F64_EDGE_ROUNDING: f32 = 1.0 / (1u64 << 52) as f32;
/// Bounds the roundings of this file, relative to absolute terms.
const ROUNDING: f32 = 1.0 / (1u64 << 49) as f32;

/// The depth of a triangle as a function of the pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DepthPlane {
    /// Nearness at the tile's first pixel, and its steps per column and row.
    pub(super) nearness: [f64; 3],
    /// Bounds the error of depth: relative, in an orthographic view in units of depth. NaN if
    /// unknown.
    pub(super) error: f32,
}

impl DepthPlanes {
    pub(super) fn new() -> DepthPlanes {
        DepthPlanes {
            groups: Vec::new(),
            count: 0,
        }
    }

    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Makes room for one more triangle and returns its lane.
    #[inline(always)]
    fn next(&mut self, primitive: InstancedId, edge_rounding: f32) -> (&mut TrianglesF64, usize) {
        let (group, lane) = (self.count / LANES, self.count % LANES);
        if group == self.groups.len() {
            self.groups.push(PlaneGroup::new());
        }
        self.count += 1;
        let group = &mut self.groups[group];
        group.primitives[lane] = primitive;
        group.edge_rounding[lane] = edge_rounding;
        (&mut group.triangles, lane)
    }

    /// Adds lane `from` of triangles whose edges are in `f32`.
    #[inline(always)]
    pub(super) fn push_f32(
        &mut self,
        primitive: InstancedId,
        corner: &[[f64; LANES]; 3],
        edges: &[[[f32; LANES]; 3]; 2],
        from: usize,
    ) {
        let (to, lane) = self.next(primitive, F32_EDGE_ROUNDING);
        for axis in 0..3 {
            to.corner[axis][lane] = corner[axis][from];
            to.edges[0][axis][lane] = f64::from(edges[0][axis][from]);
            to.edges[1][axis][lane] = f64::from(edges[1][axis][from]);
        }
    }

    /// Adds a triangle.
    pub(super) fn push(&mut self, primitive: InstancedId, triangle: &Triangle) {
        let (to, lane) = self.next(primitive, F64_EDGE_ROUNDING);
        to.put(lane, triangle);
    }

    /// Adds a primitive without a plane. The error of its depths is unknown.
    pub(super) fn push_unknown(&mut self, primitive: InstancedId) {
        // A triangle without area is seen edge-on by every ray.
        let nowhere = Triangle([Point::default(); 3]);
        self.push(primitive, &nowhere);
    }

    #[inline(always)]
    pub(super) fn primitive(&self, index: usize) -> InstancedId {
        self.groups[index / LANES].primitives[index % LANES]
    }

    /// The plane of a triangle, after [`DepthPlanes::compute`].
    #[inline(always)]
    pub(super) fn plane(&self, index: usize) -> DepthPlane {
        let (group, lane) = (&self.groups[index / LANES], index % LANES);
        DepthPlane {
            // Not by `map`, which is compiled to a loop with calls.
            nearness: [
                group.nearness[0][lane],
                group.nearness[1][lane],
                group.nearness[2][lane],
            ],
            error: group.error[lane],
        }
    }

    /// Computes the planes of all triangles.
    #[inline(always)]
    pub(super) fn compute<S: Lanes>(&mut self, simd: S, frame: &TileFrame) {
        for group in &mut self.groups[..self.count.div_ceil(LANES)] {
            group.compute(simd, frame);
        }
    }
}

impl PlaneGroup {
    fn new() -> PlaneGroup {
        PlaneGroup {
            triangles: TrianglesF64::new(),
            edge_rounding: [0.0; LANES],
            primitives: [InstancedId::alone(PrimitiveId::FIRST); LANES],
            nearness: [[0.0; LANES]; 3],
            error: [0.0; LANES],
        }
    }

    #[inline(always)]
    fn compute<S: Lanes>(&mut self, simd: S, frame: &TileFrame) {
        let view = frame.view;
        let (from_eye, edges) = self.triangles.relative_to_eye(simd, frame);
        let normal = cross::<S, true>(&edges[0], &edges[1], simd.splat_wide(0.0));
        let height = dot::<S, true>(&normal, &from_eye);
        let [start, per_column, per_row] = frame.world_from_tile;
        let along = [
            row_times::<S, true>(simd, &start, &normal),
            row_times::<S, true>(simd, &per_column, &normal),
            row_times::<S, true>(simd, &per_row, &normal),
        ];
        let (along_start, over) = if view.is_perspective {
            (along[0], height)
        } else {
            (
                along[0] - height,
                row_times::<S, true>(simd, &view.forward, &normal),
            )
        };
        let inverse = simd.splat_wide(1.0) / over;
        (along_start * inverse).store(&mut self.nearness[0]);
        (along[1] * inverse).store(&mut self.nearness[1]);
        (along[2] * inverse).store(&mut self.nearness[2]);
        let per_height = [
            normal[0] * inverse,
            normal[1] * inverse,
            normal[2] * inverse,
        ];
        let edge_rounding = simd.load(&self.edge_rounding);
        let error = depth_error(
            simd,
            view,
            &per_height,
            &from_eye,
            &edges,
            edge_rounding,
            inverse.narrow().abs(),
        );
        error.store(&mut self.error);
    }
}

/// Bounds the error of depth as the module head derives it. `per_height` is the normal over n . (v
/// - o), in an orthographic view over n . d.
#[inline(always)]
fn depth_error<S: Lanes>(
    simd: S,
    view: &CameraView,
    per_height: &[S::D; 3],
    from_eye: &[S::D; 3],
    edges: &[[S::D; 3]; 2],
    edge_rounding: S::F,
    inverse: S::F,
) -> S::F {
    let tiny = simd.splat(f32::MIN_POSITIVE);
    let (mut terms, mut longer, mut farthest) = ([tiny; 3], [tiny; 3], tiny);
    for axis in 0..3 {
        let to_second = edges[0][axis].narrow().abs();
        longer[axis] = to_second.max(edges[1][axis].narrow().abs()) + tiny;
        terms[axis] = from_eye[axis].narrow().abs() + longer[axis];
        let entry = simd.splat((view.film_from_world[2][axis].abs() * 1.0001) as f32);
        farthest = farthest + terms[axis] * entry;
    }
    if !view.is_perspective {
        farthest = simd.splat(1.0);
    }
    let rounding = simd.splat(ROUNDING);
    // n . edge is not quite 0, because n is rounded.
    let mut sum = longer[0] * rounding * longer[1] * longer[2] * inverse;
    for axis in 0..3 {
        let of_ray = farthest * simd.splat(view.ray_rounding[axis]);
        let moved = longer[axis] * edge_rounding + terms[axis] * rounding + of_ray;
        sum = sum + per_height[axis].narrow().abs() * moved;
    }
    let of_quotient = if view.is_perspective { rounding } else { tiny };
    sum * simd.splat(1.01) + of_quotient
}
