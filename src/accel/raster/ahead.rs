//! Blocks on their way from memory: while one is drawn, the next ones arrive.

use super::frame::Frame;
use super::pixels::Pixels;
use super::walk::{Stack, ViewTree};
use crate::simd::Lanes;

/// Blocks in the order in which they were come by.
#[derive(Debug, Default)]
pub(super) struct Ahead {
    /// A ring of those that are being fetched.
    coming: [u32; Ahead::COUNT],
    first: usize,
    count: usize,
    /// The blocks that follow next.
    next_block: u32,
    end_block: u32,
}

impl Ahead {
    /// Fewer wait for memory, more are looked at before what is nearer has hidden them. A power of two.
    const COUNT: usize = 4;

    /// The next block that some pixel may see, if there is one; goes on through the tree until enough are coming.
    #[inline(always)]
    pub(super) fn next<S: Lanes>(
        &mut self,
        simd: S,
        frame: &Frame,
        tree: &ViewTree,
        stack: &mut Stack,
        pixels: &Pixels,
        farthest: f32,
    ) -> Option<usize> {
        while self.count < Ahead::COUNT {
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
                stack.push(simd, frame, tree.nodes, node, pixels, farthest);
            } else {
                self.next_block = child.first;
                self.end_block = child.first + child.blocks;
            }
        }
        self.pop()
    }

    #[inline(always)]
    fn push(&mut self, block: u32) {
        self.coming[(self.first + self.count) % Ahead::COUNT] = block;
        self.count += 1;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<usize> {
        if self.count == 0 {
            return None;
        }
        let block = self.coming[self.first];
        self.first = (self.first + 1) % Ahead::COUNT;
        self.count -= 1;
        Some(block as usize)
    }
}
