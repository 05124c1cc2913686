//! The prefetch queue: while one block is rasterized, the next ones arrive from memory.

use super::hi_z::HiZ;
use super::stack::TileStack;
use super::tile_tree::TileTree;
use crate::accel::instance::ObjectBlocks;
use crate::accel::raster::depth_buffer::DepthBuffer;
use crate::accel::tree::PrimitiveBlock;
use crate::simd::Lanes;

/// Blocks that can be prefetched.
pub(crate) trait Blocks {
    /// Prefetches block `index`.
    fn prefetch<S: Lanes>(&self, simd: S, index: usize);

    /// Prefetches what the block refers to. It has arrived itself.
    fn prefetch_contents<S: Lanes>(&self, simd: S, index: usize);
}

impl Blocks for [PrimitiveBlock] {
    #[inline(always)]
    fn prefetch<S: Lanes>(&self, simd: S, index: usize) {
        simd.prefetch(&self[index]);
    }

    #[inline(always)]
    fn prefetch_contents<S: Lanes>(&self, _simd: S, _index: usize) {}
}

impl Blocks for ObjectBlocks {
    #[inline(always)]
    fn prefetch<S: Lanes>(&self, simd: S, index: usize) {
        ObjectBlocks::prefetch(self, simd, index);
    }

    #[inline(always)]
    fn prefetch_contents<S: Lanes>(&self, simd: S, index: usize) {
        self.prefetch_corners(simd, index);
    }
}

/// The next blocks in the order of traversal.
#[derive(Debug, Default)]
pub(crate) struct PrefetchQueue {
    /// A ring buffer of the blocks that are being fetched.
    coming: [u32; PrefetchQueue::DEPTH],
    first: usize,
    count: usize,
    /// The blocks of the current leaf that are not in the ring yet.
    next_block: u32,
    end_block: u32,
}

impl PrefetchQueue {
    /// Blocks in the queue, a power of two. Smaller stalls on memory; larger rasterizes blocks that
    /// a nearer one would have culled.
    const DEPTH: usize = 4;
    /// The blocks of the queue that have arrived before the last is asked for.
    const ARRIVED: usize = 2;

    /// The next block that some pixel may see. Continues the traversal until the queue is full.
    #[inline(always)]
    pub(crate) fn next<S: Lanes, B: Blocks + ?Sized>(
        &mut self,
        simd: S,
        tree: &TileTree<B>,
        stack: &mut TileStack,
        pixels: &DepthBuffer,
        hi_z: HiZ,
        cull_nearness: f32,
    ) -> Option<usize> {
        while self.count < PrefetchQueue::DEPTH {
            if self.next_block < self.end_block {
                tree.blocks.prefetch(simd, self.next_block as usize);
                self.push(self.next_block);
                self.next_block += 1;
                if self.count >= PrefetchQueue::ARRIVED {
                    let place = self.first + self.count - PrefetchQueue::ARRIVED;
                    let arrived = self.coming[place % PrefetchQueue::DEPTH];
                    tree.blocks.prefetch_contents(simd, arrived as usize);
                }
                continue;
            }
            let Some(child) = stack.pop(simd, pixels, hi_z) else {
                break;
            };
            if child.blocks == 0 {
                stack.push(simd, tree, child.first, cull_nearness);
            } else {
                self.next_block = child.first;
                self.end_block = child.first + child.blocks;
            }
        }
        self.pop()
    }

    #[inline(always)]
    fn push(&mut self, block: u32) {
        self.coming[(self.first + self.count) % PrefetchQueue::DEPTH] = block;
        self.count += 1;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<usize> {
        if self.count == 0 {
            return None;
        }
        let block = self.coming[self.first];
        self.first = (self.first + 1) % PrefetchQueue::DEPTH;
        self.count -= 1;
        Some(block as usize)
    }
}
