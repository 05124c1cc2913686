//! The triangles that pixels of a tile hit, and their depths as functions of the pixel.
//!
//! A ray o + t d passes the plane of a triangle with first corner v and normal n = e1 x e2, the edges' cross product, at
//! t = n . (v - o) / n . d. In a perspective o is the eye and d linear in the pixel, so 1/t is linear; in an orthographic view
//! d is always the same and o is linear, and so is t.
//!
//! # Bounds
//!
//! The true hit is a mean of the true corners. Its distance from the computed plane, times |n|, is the same mean of the
//! corners' errors along n: at most sum_k |n_k| s_k, where s_k bounds the errors of component k. So the computed t is off by
//! no more than that over |n . d|, relatively by that over |n . (v - o)|: no matter how narrow the triangle is. Of an
//! edge s is 2^-24 of its larger component, or 2^-53 where it was worked out in `f64`. The roundings of v - o, of n and of
//! the dot products are as if s were larger by 2^-49 (|v - o|_k + e_k), and the errors of the ray by t times its own. As n is
//! rounded, n . e is not quite 0: by 2^-52 of the absolute terms of n times e, 6 e_x e_y e_z at most.

use super::corners::{WideTriangles, cross, dot, row_times};
use super::frame::Frame;
use super::view::View;
use crate::shape::{InstancedId, PrimitiveId, Triangle};
use crate::simd::{F32s, F64s, LANES, Lanes};

/// Triangles in the order in which they were hit. Their number is the slot that pixels hold.
#[derive(Debug)]
pub(super) struct Kept {
    groups: Vec<Group>,
    count: usize,
}

/// Sixteen triangles.
#[derive(Debug, Clone)]
#[repr(align(64))]
struct Group {
    triangles: WideTriangles,
    /// What edges are off by, relative to their length.
    edge_rounding: [f32; LANES],
    primitives: [InstancedId; LANES],
    /// Nearness: at the tile's first pixel, and what a column and a row add.
    nearness: [[f64; LANES]; 3],
    /// How far depth may be off: relative, orthographic in units of depth.
    error: [f32; LANES],
}

/// Of edges that were rounded to `f32`, and of those that were worked out in `f64`.
const NARROW_ROUNDING: f32 = 1.0001 / (1 << 24) as f32;
const WIDE_ROUNDING: f32 = 1.0 / (1u64 << 52) as f32;
/// What is worked out here may be off by that part of its terms.
const ROUNDING: f32 = 1.0 / (1u64 << 49) as f32;

/// How depth depends on the pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DepthPlane {
    /// Nearness at the tile's first pixel, and what a column and a row add.
    pub(super) nearness: [f64; 3],
    /// How far depth may be off: relative, orthographic in units of depth. NaN where it is not known.
    pub(super) error: f32,
}

impl Kept {
    pub(super) fn new() -> Kept {
        Kept {
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

    /// Room for one more.
    #[inline(always)]
    fn next(&mut self, primitive: InstancedId, edge_rounding: f32) -> (&mut WideTriangles, usize) {
        let (group, lane) = (self.count / LANES, self.count % LANES);
        if group == self.groups.len() {
            self.groups.push(Group::new());
        }
        self.count += 1;
        let group = &mut self.groups[group];
        group.primitives[lane] = primitive;
        group.edge_rounding[lane] = edge_rounding;
        (&mut group.triangles, lane)
    }

    /// Adds lane `from` of triangles whose edges are in `f32`.
    #[inline(always)]
    pub(super) fn push_narrow(
        &mut self,
        primitive: InstancedId,
        corner: &[[f64; LANES]; 3],
        edges: &[[[f32; LANES]; 3]; 2],
        from: usize,
    ) {
        let (to, lane) = self.next(primitive, NARROW_ROUNDING);
        for axis in 0..3 {
            to.corner[axis][lane] = corner[axis][from];
            to.edges[0][axis][lane] = f64::from(edges[0][axis][from]);
            to.edges[1][axis][lane] = f64::from(edges[1][axis][from]);
        }
    }

    /// Adds a triangle.
    pub(super) fn push(&mut self, primitive: InstancedId, triangle: &Triangle) {
        let (to, lane) = self.next(primitive, WIDE_ROUNDING);
        to.put(lane, triangle);
    }

    #[inline(always)]
    pub(super) fn primitive(&self, place: usize) -> InstancedId {
        self.groups[place / LANES].primitives[place % LANES]
    }

    /// The plane of a triangle, after [`Kept::fill_planes`].
    #[inline(always)]
    pub(super) fn plane(&self, place: usize) -> DepthPlane {
        let (group, lane) = (&self.groups[place / LANES], place % LANES);
        DepthPlane {
            nearness: [0, 1, 2].map(|k| group.nearness[k][lane]),
            error: group.error[lane],
        }
    }

    /// Works out the planes of all.
    #[inline(always)]
    pub(super) fn fill_planes<S: Lanes>(&mut self, simd: S, frame: &Frame) {
        for group in &mut self.groups[..self.count.div_ceil(LANES)] {
            group.fill_planes(simd, frame);
        }
    }
}

impl Group {
    fn new() -> Group {
        Group {
            triangles: WideTriangles::new(),
            edge_rounding: [0.0; LANES],
            primitives: [InstancedId::alone(PrimitiveId::FIRST); LANES],
            nearness: [[0.0; LANES]; 3],
            error: [0.0; LANES],
        }
    }

    #[inline(always)]
    fn fill_planes<S: Lanes>(&mut self, simd: S, frame: &Frame) {
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
        for (coefficient, to) in [along_start, along[1], along[2]]
            .into_iter()
            .zip(&mut self.nearness)
        {
            (coefficient * inverse).store(to);
        }
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

/// See the head of the file; `per_height` is the normal over n . (v - o) or, in an orthographic view, over n . d.
#[inline(always)]
fn depth_error<S: Lanes>(
    simd: S,
    view: &View,
    per_height: &[S::D; 3],
    from_eye: &[S::D; 3],
    edges: &[[S::D; 3]; 2],
    edge_rounding: S::F,
    inverse: S::F,
) -> S::F {
    let tiny = simd.splat(f32::MIN_POSITIVE);
    let (mut terms, mut longer, mut farthest) = ([tiny; 3], [tiny; 3], tiny);
    for axis in 0..3 {
        longer[axis] = edges[0][axis]
            .narrow()
            .abs()
            .max(edges[1][axis].narrow().abs())
            + tiny;
        terms[axis] = from_eye[axis].narrow().abs() + longer[axis];
        farthest = farthest
            + terms[axis] * simd.splat((view.film_from_world[2][axis].abs() * 1.0001) as f32);
    }
    if !view.is_perspective {
        farthest = simd.splat(1.0);
    }
    let rounding = simd.splat(ROUNDING);
    // n . edge is not quite 0, for the roundings of n.
    let mut sum = longer[0] * rounding * longer[1] * longer[2] * inverse;
    for axis in 0..3 {
        let of_ray = farthest * simd.splat(view.ray_rounding[axis]);
        let moved = longer[axis] * edge_rounding + terms[axis] * rounding + of_ray;
        sum = sum + per_height[axis].narrow().abs() * moved;
    }
    let of_quotient = if view.is_perspective { rounding } else { tiny };
    sum * simd.splat(1.01) + of_quotient
}
