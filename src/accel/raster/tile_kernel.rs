//! The SIMD kernels of a tile: traversal, rasterization and depth resolve, exact or fast.

use super::instances::rasterize_instances;
use super::resolve::resolve;
use super::tile::{Tile, TileBuffers, World};
use super::traversal::{HiZ, PrefetchQueue};
use crate::accel::tree::PrimitiveBlock;
use crate::shape::{InstancedId, PrimitiveId};
use crate::simd::{Lanes, SimdKernel};

/// Decides with error bounds, so that every answer is right.
pub(super) struct ExactTile<'a>(pub(super) Tile<'a>);
/// Takes computed numbers as they are.
pub(super) struct FastTile<'a>(pub(super) Tile<'a>);

impl SimdKernel for ExactTile<'_> {
    type Output = ();
    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        run::<S, true>(self.0, simd);
    }
}

impl SimdKernel for FastTile<'_> {
    type Output = ();
    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        run::<S, false>(self.0, simd);
    }
}

/// A sibling of all primitives that belong to no instance.
const ALONE: InstancedId = InstancedId::alone(PrimitiveId::FIRST);

/// A value that the compiler has to align on the stack. Then it also aligns the registers that it
/// spills there: without this, three out of four lay across cache lines.
#[repr(align(64))]
struct Aligned(#[allow(dead_code)] u8);

#[inline(always)]
fn run<S: Lanes, const EXACT: bool>(mut tile: Tile, simd: S) {
    std::hint::black_box(&mut Aligned(0));
    rasterize_world::<S, EXACT>(&mut tile, simd);
    if !tile.instances.tree.nodes.is_empty() {
        rasterize_instances::<S, EXACT>(&mut tile, simd);
    }
    let Tile {
        frame,
        fallback,
        wanted,
        buffers,
        traced,
        fallbacks,
        ..
    } = tile;
    let pixels = &mut buffers.pixels;
    resolve(simd, &frame, &fallback, wanted, pixels, traced, fallbacks);
}

/// Rasterizes all primitives in no instance that the tile may see.
#[inline(always)]
fn rasterize_world<S: Lanes, const EXACT: bool>(tile: &mut Tile, simd: S) {
    let hi_z = HiZ::of(tile.frame.view, EXACT);
    let mut cull_nearness = hi_z.refresh(simd, &mut tile.buffers.pixels);
    if matches!(&tile.world, World::Tree(tree) if tree.nodes.is_empty()) {
        return;
    }
    tile.buffers.stack.start();
    let mut queue = PrefetchQueue::default();
    let mut filled = PrimitiveBlock::empty();
    while cull_nearness < f32::INFINITY {
        let TileBuffers { stack, pixels, .. } = &mut *tile.buffers;
        let block = match &mut tile.world {
            World::Tree(tree) => {
                let next = queue.next(simd, tree, stack, pixels, hi_z, cull_nearness);
                let blocks = tree.blocks;
                next.map(|block| &blocks[block])
            }
            World::Bins(entries) => entries
                .fill(simd, &mut filled, pixels, cull_nearness)
                .then_some(&filled),
        };
        let Some(block) = block else { return };
        tile.rasterize_block::<S, EXACT>(simd, cull_nearness, block, ALONE);
        cull_nearness = hi_z.refresh(simd, &mut tile.buffers.pixels);
    }
}
