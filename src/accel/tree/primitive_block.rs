//! Sixteen primitives side by side, laid out for SIMD.

use super::bounding_ellipsoid::BoundingEllipsoid;
use super::wide::Run;
use crate::parallel::CollectVec;
use crate::shape::{Form, Geometry, Primitive, PrimitiveId, Triangle};
use crate::simd::{LANES, Lanes};
use rayon::prelude::*;

/// Up to sixteen primitives of a leaf, in world space.
///
/// The first corner of a triangle is exact. The two edges from it are rounded to `f32`, so their
/// error is 2^-24 of their own length, whatever the size of the scene: on the film, that is a small
/// part of the triangle itself.
///
/// For a quadric or a segment, `corner` and `edges` hold its [`BoundingEllipsoid`].
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
pub(crate) struct PrimitiveBlock {
    /// Coordinates of the first corners.
    pub(crate) corner: [[f64; LANES]; 3],
    /// Components of the vectors from the first to the second corners, and to the third.
    pub(crate) edges: [[[f32; LANES]; 3]; 2],
    /// Only the first `count` are meaningful.
    pub(crate) primitives: [PrimitiveId; LANES],
    /// The number of lanes that hold a primitive: the first ones.
    pub(crate) count: u32,
    /// Lanes that hold a triangle, lane k as bit k.
    pub(crate) triangles: u32,
    /// Lanes that hold a whole sphere, lane k as bit k. Its shape matrix is the square of the
    /// radius times the identity, but for 2^-20 of that.
    pub(crate) spheres: u32,
    /// Lanes that hold a segment of a curve, lane k as bit k.
    pub(crate) segments: u32,
}

/// The triangles of a block in lanes: see [`PrimitiveBlock`]. Other lanes have no meaning.
pub(crate) struct TriangleLanes<S: Lanes> {
    /// The first corners.
    pub(crate) first: [S::D; 3],
    /// The edges from the first corners to the second, and to the third.
    pub(crate) edges: [[S::F; 3]; 2],
}

/// The number of primitives that a block holds.
pub(crate) const BLOCK_SIZE: usize = LANES;

impl PrimitiveBlock {
    /// A block without primitives.
    pub(crate) fn empty() -> PrimitiveBlock {
        PrimitiveBlock {
            corner: [[0.0; LANES]; 3],
            edges: [[[0.0; LANES]; 3]; 2],
            primitives: [PrimitiveId::triangle(0); LANES],
            count: 0,
            triangles: 0,
            spheres: 0,
            segments: 0,
        }
    }

    /// Lanes that hold a quadric or a segment, lane k as bit k.
    pub(crate) fn curved(&self) -> u32 {
        ((1 << self.count) - 1) & !self.triangles
    }

    /// Loads the triangles.
    #[inline(always)]
    pub(crate) fn triangle_lanes<S: Lanes>(&self, simd: S) -> TriangleLanes<S> {
        let [x, y, z] = &self.corner;
        let edge = |[x, y, z]: &[[f32; LANES]; 3]| [simd.load(x), simd.load(y), simd.load(z)];
        TriangleLanes {
            first: [simd.load_wide(x), simd.load_wide(y), simd.load_wide(z)],
            edges: [edge(&self.edges[0]), edge(&self.edges[1])],
        }
    }

    /// Removes all primitives.
    pub(crate) fn clear(&mut self) {
        (self.count, self.triangles) = (0, 0);
        (self.spheres, self.segments) = (0, 0);
    }

    /// Adds a primitive with the geometry `surface`. The block must not be full.
    #[inline]
    pub(crate) fn push(&mut self, primitive: PrimitiveId, surface: &Primitive) {
        match surface {
            Primitive::Triangle(triangle) => self.push_triangle(primitive, triangle),
            Primitive::Quadric(quadric) => {
                let lane = self.next_lane(primitive);
                let ellipsoid = BoundingEllipsoid::of(quadric);
                let is_whole = quadric.form == Form::Sphere(None);
                let is_sphere = is_whole && is_round(&ellipsoid.shape);
                self.spheres |= u32::from(is_sphere) << lane;
                self.put_ellipsoid(lane, &ellipsoid);
            }
            Primitive::Segment(segment) => {
                let lane = self.next_lane(primitive);
                self.segments |= 1 << lane;
                self.put_ellipsoid(lane, &BoundingEllipsoid::of_segment(segment));
            }
        }
    }

    #[inline(always)]
    fn next_lane(&mut self, primitive: PrimitiveId) -> usize {
        let lane = self.count as usize;
        self.primitives[lane] = primitive;
        self.count += 1;
        lane
    }

    /// Adds a triangle. The block must not be full.
    #[inline(always)]
    pub(crate) fn push_triangle(&mut self, primitive: PrimitiveId, triangle: &Triangle) {
        let lane = self.next_lane(primitive);
        self.triangles |= 1 << lane;
        let [a, b, c] = &triangle.0;
        for axis in 0..3 {
            self.corner[axis][lane] = a[axis];
            self.edges[0][axis][lane] = (b[axis] - a[axis]) as f32;
            self.edges[1][axis][lane] = (c[axis] - a[axis]) as f32;
        }
    }

    fn put_ellipsoid(&mut self, lane: usize, ellipsoid: &BoundingEllipsoid) {
        let BoundingEllipsoid { centre, shape } = ellipsoid;
        for axis in 0..3 {
            self.corner[axis][lane] = centre[axis];
            self.edges[0][axis][lane] = shape[axis];
            self.edges[1][axis][lane] = shape[3 + axis];
        }
    }
}

/// Tests whether an ellipsoid of this shape matrix is as good as a sphere.
fn is_round(shape: &[f32; 6]) -> bool {
    let [x, y, z, mixed @ ..] = *shape;
    let allowed = x * (1.0 / (1 << 22) as f32);
    let is_small = |number: f32| number.abs() <= allowed;
    is_small(y - x) && is_small(z - x) && mixed.into_iter().all(is_small)
}

/// The blocks of runs of up to [`BLOCK_SIZE`] primitives that belong to no instance.
pub(crate) fn primitive_blocks(
    runs: &[Run],
    order: &[PrimitiveId],
    geometry: &Geometry,
) -> Vec<PrimitiveBlock> {
    let block = |run: &Run| {
        let mut block = PrimitiveBlock::empty();
        for primitive in run.of(order) {
            block.push(*primitive, &geometry.own_surface(*primitive));
        }
        block
    };
    runs.par_iter().with_min_len(64).map(block).collect_vec()
}
