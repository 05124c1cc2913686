//! The nodes that a tile has still to visit.

use super::hi_z::{HiZ, four_by_four, pixel_blocks_between};
use super::node_footprints::NodeFootprints;
use super::tile_tree::TileTree;
use crate::accel::raster::depth_buffer::{BLOCK_SIDE, DepthBuffer};
use crate::accel::tree::Child;
use crate::accel::view::TILE;
use crate::simd::{F32s, LANES, Lanes, Mask};

/// A child to visit.
#[derive(Debug, Clone, Copy)]
struct Pending {
    /// An upper bound of the nearness of everything in the child.
    nearness: f32,
    /// First and last columns of the pixels that may see it.
    columns: [u8; 2],
    /// First and last rows.
    rows: [u8; 2],
    child: Child,
}

/// Leaves that touch more blocks of pixels are not compared with each pixel.
const FEW_BLOCKS: u32 = 4;

impl Pending {
    /// The root, before anything is known of it.
    const ROOT: Pending = Pending {
        nearness: f32::INFINITY,
        columns: [0, TILE as u8 - 1],
        rows: [0, TILE as u8 - 1],
        child: Child {
            first: 0,
            blocks: 0,
        },
    };

    /// Tests whether some pixel may see the child.
    #[inline(always)]
    fn is_seen<S: Lanes>(&self, simd: S, pixels: &DepthBuffer, hi_z: HiZ) -> bool {
        let touched = pixel_blocks_between(self.columns.map(i32::from), self.rows.map(i32::from));
        let hidden = simd.load(&pixels.hi_z).above(simd.splat(self.nearness));
        let blocks = touched & !hidden.bits();
        // A leaf costs more than a look at its pixels, a node does not.
        if blocks == 0 || self.child.blocks == 0 || touched.count_ones() > FEW_BLOCKS {
            return blocks != 0;
        }
        self.is_seen_within(simd, pixels, hi_z, blocks)
    }

    /// Tests whether some pixel of `blocks` may see the child.
    #[inline(always)]
    fn is_seen_within<S: Lanes>(
        &self,
        simd: S,
        pixels: &DepthBuffer,
        hi_z: HiZ,
        mut blocks: u32,
    ) -> bool {
        let nearness = simd.splat(self.nearness);
        while blocks != 0 {
            let block = blocks.trailing_zeros();
            blocks &= blocks - 1;
            let best = simd.load(&pixels.nearness[block as usize]);
            let hidden = hi_z.cull_nearness_of(simd, best).above(nearness).bits();
            // The pixels of a block are arranged as the blocks of a tile.
            let columns = within(self.columns, block % BLOCK_SIDE);
            let rows = within(self.rows, block / BLOCK_SIDE);
            if four_by_four(columns, rows) & !hidden != 0 {
                return true;
            }
        }
        false
    }
}

/// The part of a range of pixels that lies in a row or column of blocks, relative to its first.
#[inline(always)]
fn within([first, last]: [u8; 2], block: u32) -> [u32; 2] {
    let start = block * BLOCK_SIDE;
    [
        u32::from(first).saturating_sub(start),
        (u32::from(last) - start).min(BLOCK_SIDE - 1),
    ]
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
        self.pending.push(Pending::ROOT);
    }

    /// Removes the next child that some pixel may see.
    #[inline(always)]
    pub(crate) fn pop<S: Lanes>(
        &mut self,
        simd: S,
        pixels: &DepthBuffer,
        hi_z: HiZ,
    ) -> Option<Child> {
        while let Some(next) = self.pending.pop() {
            if next.is_seen(simd, pixels, hi_z) {
                return Some(next.child);
            }
        }
        None
    }

    /// Adds the children of a node that the tile may see, the nearest last, and prefetches those of
    /// them that are nodes.
    #[inline(always)]
    pub(crate) fn push<S: Lanes, B: ?Sized>(
        &mut self,
        simd: S,
        tree: &TileTree<B>,
        node: u32,
        cull_nearness: f32,
    ) {
        let node = &tree.nodes[node as usize];
        let footprints = NodeFootprints::of(simd, &tree.from_tree, node, cull_nearness);
        let seen = footprints.seen;
        let bottom = self.pending.len();
        let end = bottom + seen.count_ones() as usize;
        self.pending.resize(end, Pending::ROOT);
        let pending = &mut self.pending[bottom..];
        let all = simd.load(&footprints.nearness);
        let mut rest = seen;
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize;
            rest &= rest - 1;
            let child = node.children[lane];
            if child.blocks == 0 {
                simd.prefetch(&tree.nodes[child.first as usize]);
            }
            let nearness = footprints.nearness[lane];
            // Sorted by counting: those before it are less near, or as near and of a lower lane.
            let own = simd.splat(nearness);
            let less_near = own.above(all).bits();
            let as_near = !all.above(own).bits() & ((1 << lane) - 1);
            let place = ((less_near | as_near) & seen).count_ones() as usize;
            let ends = |ends: &[[i32; LANES]; 2]| [ends[0][lane] as u8, ends[1][lane] as u8];
            pending[place] = Pending {
                nearness,
                columns: ends(&footprints.columns),
                rows: ends(&footprints.rows),
                child,
            };
        }
    }
}
