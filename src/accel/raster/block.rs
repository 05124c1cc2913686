//! Sixteen triangles side by side.

use super::spheres::Spread;
use super::wide_tree::Run;
use crate::shape::{Geometry, Primitive, PrimitiveId, Quadric, Triangle};
use crate::simd::LANES;
use rayon::prelude::*;

/// Primitives of a leaf, laid out for lanes, in world space.
///
/// Of triangles a first corner is exact. The two edges from it are rounded to `f32`, so that they are off by 2^-24 of their own length,
/// whatever the size of the scene: on the film, by a small part of the triangle itself.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
pub(crate) struct Block {
    /// Coordinates of the first corners.
    pub(super) corner: [[f64; LANES]; 3],
    /// Components of the vectors from the first to the second corners, and to the third.
    pub(super) edges: [[[f32; LANES]; 3]; 2],
    /// Those from `count` on mean nothing.
    pub(super) primitives: [PrimitiveId; LANES],
    /// Lanes that hold a primitive: the first ones.
    pub(super) count: u32,
    /// Lanes that hold a triangle, lane k as bit k.
    pub(super) triangles: u32,
}

/// The largest run of primitives that one block holds.
pub(in crate::accel) const BLOCK: usize = LANES;

impl Block {
    /// Lanes that hold a sphere, a cylinder or a disk.
    pub(super) fn spheres(&self) -> u32 {
        ((1 << self.count) - 1) & !self.triangles
    }

    pub(super) fn empty() -> Block {
        Block {
            corner: [[0.0; LANES]; 3],
            edges: [[[0.0; LANES]; 3]; 2],
            primitives: [PrimitiveId::triangle(0); LANES],
            count: 0,
            triangles: 0,
        }
    }

    /// Holds nothing any more.
    pub(super) fn clear(&mut self) {
        (self.count, self.triangles) = (0, 0);
    }

    /// Adds a primitive, which is at `surface`, to the up to 15 that there are.
    #[inline]
    pub(super) fn push(&mut self, primitive: PrimitiveId, surface: &Primitive) {
        let lane = self.count as usize;
        self.primitives[lane] = primitive;
        self.count += 1;
        match surface {
            Primitive::Triangle(triangle) => self.put_triangle(lane, triangle),
            Primitive::Quadric(quadric) => self.put_sphere(lane, quadric),
        }
    }

    #[inline]
    fn put_triangle(&mut self, lane: usize, triangle: &Triangle) {
        self.triangles |= 1 << lane;
        let [a, b, c] = &triangle.0;
        for axis in 0..3 {
            self.corner[axis][lane] = a[axis];
            self.edges[0][axis][lane] = (b[axis] - a[axis]) as f32;
            self.edges[1][axis][lane] = (c[axis] - a[axis]) as f32;
        }
    }

    /// Spheres have their centres for corners, and for edges what [`Spread`] tells of them.
    fn put_sphere(&mut self, lane: usize, quadric: &Quadric) {
        let Spread { centre, entries } = Spread::of(quadric);
        for axis in 0..3 {
            self.corner[axis][lane] = centre[axis];
            self.edges[0][axis][lane] = entries[axis];
            self.edges[1][axis][lane] = entries[3 + axis];
        }
    }
}

/// The blocks of runs of up to [`BLOCK`] primitives that are in no instance.
pub(in crate::accel) fn blocks_of(
    runs: &[Run],
    order: &[PrimitiveId],
    geometry: &Geometry,
) -> Vec<Block> {
    let block = |run: &Run| {
        let mut block = Block::empty();
        run.of(order)
            .iter()
            .for_each(|primitive| block.push(*primitive, &geometry.own_surface(*primitive)));
        block
    };
    runs.par_iter().with_min_len(64).map(block).collect()
}
