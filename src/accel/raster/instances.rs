//! Instances before the rays of a tile.
//!
//! The boxes of an object's tree are projected when a tile comes by, by the view's matrix times that of the instance. What is in
//! the leaves that are seen is moved to the world, and drawn like everything else.

use super::block::Block;
use super::cast::{Scratch, Tile};
use super::view_node::{FilmFromTree, project};
use super::walk::Occlusion;
use crate::accel::instance::ObjectTree;
use crate::shape::{InstancedId, Pose, Primitive, PrimitiveId};
use crate::simd::Lanes;

impl Tile<'_> {
    /// Draws all that the tile may see of instances.
    #[inline(always)]
    pub(super) fn walk_instances<S: Lanes, const EXACT: bool>(&mut self, simd: S) {
        let occlusion = Occlusion::of(self.frame.view, EXACT);
        let trees = &self.searcher.aggregate.instances;
        let mut farthest = occlusion.refresh(simd, &mut self.scratch.pixels);
        let mut block = Block::empty();
        self.scratch.stack.start();
        while farthest < f32::INFINITY {
            let Scratch { stack, pixels, .. } = &mut *self.scratch;
            let Some(child) = stack.pop(simd, pixels) else {
                return;
            };
            if child.blocks == 0 {
                let node = &self.instances[child.first as usize];
                stack.push(simd, &self.frame, self.instances, node, pixels, farthest);
                continue;
            }
            for run in &trees.wide.blocks[child.first as usize..][..child.blocks as usize] {
                for instance in run.of(&trees.tree.order) {
                    farthest = self.walk_object::<S, EXACT>(
                        simd,
                        farthest,
                        occlusion,
                        *instance as usize,
                        &mut block,
                    );
                }
            }
        }
    }

    /// Draws what the tile may see of an instance, by way of `block`, and returns how near something must be now to be seen.
    #[inline(always)]
    fn walk_object<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        mut farthest: f32,
        occlusion: Occlusion,
        instance: usize,
        block: &mut Block,
    ) -> f32 {
        let geometry = self.searcher.geometry;
        let object: &ObjectTree = self.searcher.aggregate.instances.object(geometry, instance);
        let placement = object.placement(&geometry.instances()[instance]);
        let film = FilmFromTree::of_object(self.frame.view, &object.space, &placement);
        let mut pose = geometry.pose(instance);
        let sibling = InstancedId::in_instance(instance, PrimitiveId::FIRST);
        self.scratch.object_stack.start();
        while farthest < f32::INFINITY {
            let Scratch {
                object_stack,
                pixels,
                ..
            } = &mut *self.scratch;
            let Some(child) = object_stack.pop(simd, pixels) else {
                break;
            };
            if child.blocks == 0 {
                let nodes = &object.wide.nodes;
                let node = project(simd, &film, &nodes[child.first as usize]);
                object_stack.push(simd, &self.frame, nodes, &node, pixels, farthest);
                continue;
            }
            for run in &object.wide.blocks[child.first as usize..][..child.blocks as usize] {
                fill(block, run.of(&object.tree.order), &mut pose);
                self.show_block::<S, EXACT>(simd, farthest, block, sibling);
                farthest = occlusion.refresh(simd, &mut self.scratch.pixels);
            }
        }
        farthest
    }
}

/// Fills a block with primitives of an object as an instance poses it; without those that are nowhere, or cannot be hit there.
fn fill(block: &mut Block, primitives: &[PrimitiveId], pose: &mut Pose) {
    block.clear();
    for primitive in primitives {
        let surface = pose.surface(*primitive);
        let is_there = match &surface {
            // Those without area are left to the tests of rays.
            Primitive::Triangle(triangle) => triangle.0.iter().all(|corner| corner.is_finite()),
            Primitive::Quadric(quadric) => quadric.can_be_hit(),
        };
        if is_there {
            block.push(*primitive, &surface);
        }
    }
}
