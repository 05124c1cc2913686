//! Sixteen triangles side by side.

use super::spheres::Spread;
use crate::shape::{Primitive, Quadric, Shapes};
use crate::simd::LANES;
use rayon::prelude::*;

/// Primitives of a leaf, laid out for lanes, in world space.
///
/// Of triangles a first corner is exact. The two edges from it are rounded to `f32`, so that they are off by 2^-24 of their own length,
/// whatever the size of the scene: on the film, by a small part of the triangle itself.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
pub(super) struct Block {
    /// Coordinates of the first corners.
    pub(super) corner: [[f64; LANES]; 3],
    /// Components of the vectors from the first to the second corners, and to the third.
    pub(super) edges: [[[f32; LANES]; 3]; 2],
    /// Those from `count` on mean nothing.
    pub(super) primitives: [Primitive; LANES],
    /// Lanes that hold a primitive: the first ones.
    pub(super) count: u32,
    /// Lanes that hold a triangle, lane k as bit k.
    pub(super) triangles: u32,
}

/// The largest run of primitives that one block holds.
pub(super) const BLOCK: usize = LANES;

impl Block {
    /// Lanes that hold a sphere, a cylinder or a disk.
    pub(super) fn spheres(&self) -> u32 {
        ((1 << self.count) - 1) & !self.triangles
    }

    pub(super) fn empty() -> Block {
        Block {
            corner: [[0.0; LANES]; 3],
            edges: [[[0.0; LANES]; 3]; 2],
            primitives: [Primitive::triangle(0); LANES],
            count: 0,
            triangles: 0,
        }
    }

    fn of(primitives: &[Primitive], shapes: &Shapes) -> Block {
        let mut block = Block { count: primitives.len() as u32, ..Block::empty() };
        for (lane, primitive) in primitives.iter().enumerate() {
            block.primitives[lane] = *primitive;
            if primitive.is_sphere() {
                block.put_sphere(lane, &shapes.sphere(primitive.index()));
                continue;
            }
            block.triangles |= 1 << lane;
            let [a, b, c] = shapes.triangle(primitive.index()).0;
            for axis in 0..3 {
                block.corner[axis][lane] = a[axis];
                block.edges[0][axis][lane] = (b[axis] - a[axis]) as f32;
                block.edges[1][axis][lane] = (c[axis] - a[axis]) as f32;
            }
        }
        block
    }
}

impl Block {
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

/// The blocks of runs of primitives, given as the place of the first in `order` and their number, at most [`BLOCK`].
pub(super) fn blocks_of(runs: &[(u32, u32)], order: &[Primitive], shapes: &Shapes) -> Vec<Block> {
    let block = |(first, count): &(u32, u32)| Block::of(&order[*first as usize..][..*count as usize], shapes);
    runs.par_iter().with_min_len(64).map(block).collect()
}
