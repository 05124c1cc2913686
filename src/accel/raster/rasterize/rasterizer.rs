//! The inputs and outputs of rasterization, and the slots of the triangles that pixels see.

use crate::accel::raster::depth_buffer::{DepthBuffer, Slot};
use crate::accel::raster::exact_fallback::Unresolved;
use crate::accel::raster::setup::EdgePlanes;
use crate::accel::tree::PrimitiveBlock;
use crate::shape::{Geometry, InstancedId, PrimitiveId};
use crate::simd::{F32s, LANES, Lanes};

/// Decides which hits win.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rule {
    /// In a perspective, nearness is positive in front of the eye; in an orthographic view
    /// negative.
    pub(crate) is_perspective: bool,
    /// A hit is surely nearer if its nearness exceeds this factor times the best plus this addend.
    pub(crate) surely_nearer: [f32; 2],
    /// Only whether a pixel hits anything matters.
    pub(crate) hits_only: bool,
}

impl Rule {
    /// The computed hits that are in front of the eye, without those that are NaN.
    #[inline(always)]
    pub(super) fn in_front<S: Lanes>(&self, simd: S, nearness: S::F) -> S::M {
        let zero = simd.splat(0.0);
        if self.is_perspective {
            nearness.above(zero)
        } else {
            zero.above(nearness)
        }
    }
}

/// Sixteen primitives of one instance, or of none.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PrimitiveBatch<'a> {
    pub(crate) primitives: &'a [PrimitiveId; LANES],
    /// Any primitive of the same instance.
    pub(crate) sibling: InstancedId,
}

impl PrimitiveBatch<'_> {
    #[inline(always)]
    pub(crate) fn of(&self, lane: usize) -> InstancedId {
        self.sibling.sibling(self.primitives[lane])
    }
}

/// The triangles that depth planes are computed from.
#[derive(Debug, Clone, Copy)]
pub(crate) enum TriangleSource<'a> {
    /// Those of a block, with edges in `f32`.
    Block(&'a PrimitiveBlock),
    /// Those of the scene, because the edges of the block are not precise enough.
    Geometry,
}

/// Rasterizes batches of triangles into a tile.
pub(crate) struct Rasterizer<'a> {
    pub(crate) batch: PrimitiveBatch<'a>,
    pub(crate) source: TriangleSource<'a>,
    pub(crate) geometry: &'a Geometry,
    pub(crate) rule: Rule,
    pub(crate) pixels: &'a mut DepthBuffer,
    /// Receives the pixels that `f32` cannot decide.
    pub(crate) unresolved: &'a mut Vec<Unresolved>,
}

/// Depth planes from edges in `f32` leave too many depths open for a triangle that covers more
/// pixels: it is worth fetching its corners.
const MANY_PIXELS: u32 = 64;

impl Rasterizer<'_> {
    /// The slot that the next visible triangle gets.
    #[inline(always)]
    pub(super) fn next_slot(&self) -> Slot {
        // If only hits count, all share one.
        if self.rule.hits_only {
            0
        } else {
            self.pixels.planes.len() as Slot
        }
    }

    /// Adds a visible triangle to the depth planes.
    #[inline(always)]
    pub(super) fn add_plane<const EXACT: bool>(&mut self, planes: &EdgePlanes, lane: usize) {
        let primitive = self.batch.of(lane);
        let depth_planes = &mut self.pixels.planes;
        if self.rule.hits_only && depth_planes.len() > 0 {
            return;
        }
        match self.source {
            TriangleSource::Block(block) if !EXACT || planes.pixel_count(lane) <= MANY_PIXELS => {
                depth_planes.push_f32(primitive, &block.corner, &block.edges, lane);
            }
            _ => depth_planes.push(primitive, &self.geometry.placed_triangle(primitive)),
        }
    }
}
