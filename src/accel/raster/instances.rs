//! Rasterizes instances into a tile.
//!
//! The boxes of an object's tree are projected for each tile, by the view's matrix times that of
//! the instance. The primitives of the leaves that may be seen are moved to the world and then
//! rasterized like all others.

use super::tile::{Tile, TileBuffers};
use super::traversal::{HiZ, PrefetchQueue, TileFromTree, TileTree};
use crate::accel::tree::PrimitiveBlock;
use crate::shape::{InstancedId, Pose, Primitive, PrimitiveId};
use crate::simd::Lanes;

/// Rasterizes all instances that the tile may see.
#[inline(always)]
pub(super) fn rasterize_instances<S: Lanes, const EXACT: bool>(tile: &mut Tile, simd: S) {
    let hi_z = HiZ::of(tile.frame.view, EXACT);
    let trees = tile.instances.trees;
    let mut cull_nearness = hi_z.refresh(simd, &mut tile.buffers.pixels);
    let mut block = PrimitiveBlock::empty();
    tile.buffers.stack.start();
    while cull_nearness < f32::INFINITY {
        let TileBuffers { stack, pixels, .. } = &mut *tile.buffers;
        let Some(child) = stack.pop(simd, pixels, hi_z) else {
            return;
        };
        if child.blocks == 0 {
            stack.push(simd, &tile.instances.tree, child.first, cull_nearness);
            continue;
        }
        for run in &tile.instances.tree.blocks[child.first as usize..][..child.blocks as usize] {
            for instance in run.of(&trees.tree.order) {
                let instance = *instance as usize;
                cull_nearness = rasterize_instance::<S, EXACT>(
                    tile,
                    simd,
                    cull_nearness,
                    hi_z,
                    instance,
                    &mut block,
                );
            }
        }
    }
}

/// Rasterizes one instance, and returns the new nearness below which the tile sees nothing. `block`
/// is a buffer.
#[inline(always)]
fn rasterize_instance<S: Lanes, const EXACT: bool>(
    tile: &mut Tile,
    simd: S,
    mut cull_nearness: f32,
    hi_z: HiZ,
    instance: usize,
    block: &mut PrimitiveBlock,
) -> f32 {
    let geometry = tile.fallback.geometry;
    let object = tile.instances.trees.object(geometry, instance);
    let placement = object.placement(&geometry.instances()[instance]);
    let tree = TileTree {
        from_tree: TileFromTree::of_object(&tile.frame, &object.space, &placement),
        nodes: &object.wide.nodes,
        blocks: &object.blocks,
    };
    let mut pose = geometry.pose(instance);
    let sibling = InstancedId::in_instance(instance, PrimitiveId::FIRST);
    tile.buffers.object_stack.start();
    let mut queue = PrefetchQueue::default();
    while cull_nearness < f32::INFINITY {
        let TileBuffers {
            object_stack,
            pixels,
            ..
        } = &mut *tile.buffers;
        let Some(next) = queue.next(simd, &tree, object_stack, pixels, hi_z, cull_nearness) else {
            break;
        };
        let in_lanes = object.blocks.first_triangle(next);
        let in_lanes = in_lanes.filter(|_| placement.is_finite);
        match in_lanes.map(|triangle| pose.world_from_mesh(triangle)) {
            Some(world_from_mesh) if world_from_mesh.is_finite() => {
                object.blocks.place(simd, next, world_from_mesh, block);
            }
            _ => fill(block, object.blocks.primitives(next), &mut pose),
        }
        tile.rasterize_block::<S, EXACT>(simd, cull_nearness, block, sibling);
        cull_nearness = hi_z.refresh(simd, &mut tile.buffers.pixels);
    }
    cull_nearness
}

/// Fills a block with primitives of an object in the pose of an instance. Leaves out those that are
/// not finite or cannot be hit there.
fn fill(block: &mut PrimitiveBlock, primitives: &[PrimitiveId], pose: &mut Pose) {
    block.clear();
    for primitive in primitives {
        let surface = pose.surface(*primitive);
        let is_there = match &surface {
            // Triangles without area are left to the ray tests.
            Primitive::Triangle(triangle) => triangle.0.iter().all(|corner| corner.is_finite()),
            Primitive::Quadric(_) | Primitive::Segment(_) => surface.can_be_hit(),
        };
        if is_there {
            block.push(*primitive, &surface);
        }
    }
}
