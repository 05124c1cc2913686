//! The prefetch queue: while one block is rasterized, the next ones arrive from memory.

use super::projected_node::ProjectedNode;
use super::stack::TileStack;
use crate::accel::raster::depth_buffer::DepthBuffer;
use crate::accel::tree::PrimitiveBlock;
use crate::accel::view::TileFrame;
use crate::simd::Lanes;

/// The world's tree as a view sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ViewTree<'a> {
    pub(crate) nodes: &'a [ProjectedNode],
    pub(crate) blocks: &'a [PrimitiveBlock],
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

    /// The next block that some pixel may see. Continues the traversal until the queue is full.
    #[inline(always)]
    pub(crate) fn next<S: Lanes>(
        &mut self,
        simd: S,
        frame: &TileFrame,
        tree: &ViewTree,
        stack: &mut TileStack,
        pixels: &DepthBuffer,
        cull_nearness: f32,
    ) -> Option<usize> {
        while self.count < PrefetchQueue::DEPTH {
            if self.next_block < self.end_block {
                let block = self.next_block;
                self.next_block += 1;
                simd.prefetch(&tree.blocks[block as usize]);
                self.push(block);
                continue;
            }
            let Some(child) = stack.pop(simd, pixels) else {
                break;
            };
            if child.blocks == 0 {
                let node = &tree.nodes[child.first as usize];
                stack.push(simd, frame, tree.nodes, node, pixels, cull_nearness);
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
