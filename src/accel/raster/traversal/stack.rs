//! The nodes that a tile has still to visit.

use super::hi_z::pixel_blocks_between;
use super::projected_node::ProjectedNode;
use crate::accel::raster::depth_buffer::{DepthBuffer, PIXEL_BLOCKS};
use crate::accel::tree::Child;
use crate::accel::view::{TILE, TileFrame};
use crate::simd::{F32s, LANES, Lanes, Mask};

/// A child to visit.
#[derive(Debug, Clone, Copy)]
struct Pending {
    /// An upper bound of the nearness of everything in the child.
    nearness: f32,
    /// The blocks of pixels that may see it, block k as bit k.
    pixel_blocks: u32,
    child: Child,
}

/// The children to visit, the next one last.
#[derive(Debug, Default)]
pub(crate) struct TileStack {
    pending: Vec<Pending>,
}

impl TileStack {
    /// Starts at the root.
    pub(crate) fn start(&mut self) {
        self.pending.clear();
        self.pending.push(Pending {
            nearness: f32::INFINITY,
            pixel_blocks: (1 << PIXEL_BLOCKS) - 1,
            child: Child {
                first: 0,
                blocks: 0,
            },
        });
    }

    /// Removes the next child that some pixel may see.
    #[inline(always)]
    pub(crate) fn pop<S: Lanes>(&mut self, simd: S, pixels: &DepthBuffer) -> Option<Child> {
        while let Some(next) = self.pending.pop() {
            let hi_z = simd.load(&pixels.hi_z);
            let hidden = hi_z.above(simd.splat(next.nearness)).bits();
            if next.pixel_blocks & !hidden != 0 {
                return Some(next.child);
            }
        }
        None
    }

    /// Adds the children of `node` that the tile may see, the nearest last, and prefetches those of
    /// them that are in `nodes`.
    #[inline(always)]
    pub(crate) fn push<S: Lanes, N>(
        &mut self,
        simd: S,
        frame: &TileFrame,
        nodes: &[N],
        node: &ProjectedNode,
        pixels: &DepthBuffer,
        cull_nearness: f32,
    ) {
        let (zero, last_pixel) = (simd.splat(0.0), simd.splat(TILE as f32 - 1.0));
        let nearness = simd.load(&node.nearness);
        let mut ends = [[[0i32; LANES]; 2]; 2];
        let mut seen = !simd.splat(cull_nearness).above(nearness);
        for (axis, sides) in [&node.columns, &node.rows].into_iter().enumerate() {
            let first_pixel = simd.splat(frame.first[axis] as f32);
            let first = (simd.load(&sides[0]) - first_pixel).ceil().max(zero);
            let last = (simd.load(&sides[1]) - first_pixel).floor().min(last_pixel);
            seen = seen & !first.above(last);
            first.store_whole(&mut ends[axis][0]);
            last.store_whole(&mut ends[axis][1]);
        }
        let mut seen = seen.bits() & node.visible;
        let bottom = self.pending.len();
        let hi_z = simd.load(&pixels.hi_z);
        while seen != 0 {
            let lane = seen.trailing_zeros() as usize;
            seen &= seen - 1;
            let side = |axis: usize| [ends[axis][0][lane], ends[axis][1][lane]];
            let nearness = node.nearness[lane];
            let pixel_blocks = pixel_blocks_between(side(0), side(1));
            if pixel_blocks & !hi_z.above(simd.splat(nearness)).bits() == 0 {
                continue;
            }
            let child = node.children[lane];
            if child.blocks == 0 {
                simd.prefetch(&nodes[child.first as usize]);
            }
            let pending = Pending {
                nearness,
                pixel_blocks,
                child,
            };
            self.insert(bottom, pending);
        }
    }

    /// Inserts a child so that those from index `bottom` on stay in order.
    #[inline(always)]
    fn insert(&mut self, bottom: usize, pending: Pending) {
        self.pending.push(pending);
        let mut place = self.pending.len() - 1;
        while place > bottom && self.pending[place - 1].nearness > pending.nearness {
            self.pending[place] = self.pending[place - 1];
            place -= 1;
        }
        self.pending[place] = pending;
    }
}
