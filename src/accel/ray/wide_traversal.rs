//! The traversal of the wide trees by one ray: sixteen boxes, or sixteen triangles, at once.

use super::box_test::{BoxTest, Entered, WorldBoxes};
use super::narrow_ray::NarrowRay;
use super::placed_boxes::PlacedBoxes;
use super::search::Search;
use super::surely_missed::surely_missed;
use super::wide_stack::{Pending, WideStack};
use crate::accel::Aggregate;
use crate::accel::instance::ObjectTree;
use crate::accel::space::SlabRay;
use crate::accel::tree::{Child, PrimitiveBlock, WideNode};
use crate::geometry::Ray;
use crate::shape::{Geometry, InstancedId};
use crate::simd::{Lanes, SimdKernel};

/// The stacks for the world's trees and for an object's tree.
#[derive(Debug, Default)]
pub(super) struct WideStacks {
    world: WideStack,
    object: WideStack,
}

/// Traverses the wide trees of an aggregate over `geometry`, and lets `search` test the primitives
/// that the ray may hit.
pub(super) struct WideTraversal<'a> {
    pub(super) aggregate: &'a Aggregate,
    pub(super) geometry: &'a Geometry,
    pub(super) ray: &'a Ray,
    pub(super) slab: &'a SlabRay,
    pub(super) stacks: &'a mut WideStacks,
    pub(super) search: &'a mut dyn Search,
}

impl SimdKernel for WideTraversal<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        let WideStacks { world, object } = self.stacks;
        let boxes = WorldBoxes { slab: self.slab };
        let mut blocks = WorldLeaves {
            blocks: &self.aggregate.wide.blocks,
            ray: NarrowRay::new(self.ray),
            t_per_scaled_t: self.slab.t_per_scaled_t(),
            may_leave_out: self.search.is_exact(),
        };
        let nodes = &self.aggregate.wide.nodes;
        visit(simd, nodes, &boxes, &mut blocks, world, self.search);
        let nodes = &self.aggregate.instances.wide.nodes;
        if !nodes.is_empty() {
            let mut instances = InstanceLeaves {
                aggregate: self.aggregate,
                geometry: self.geometry,
                ray: self.ray,
                slab: self.slab,
                stack: object,
            };
            visit(simd, nodes, &boxes, &mut instances, world, self.search);
        }
    }
}

/// The leaves of a wide tree.
trait Leaves<S: Lanes> {
    /// Tests the primitives of a leaf, which the ray enters at `near`.
    fn visit(&mut self, simd: S, leaf: Child, near: f32, search: &mut dyn Search);
}

/// Visits the children that the ray enters, the nearest first, as far as the search has to go.
#[inline(always)]
fn visit<S: Lanes>(
    simd: S,
    nodes: &[WideNode],
    boxes: &impl BoxTest<S>,
    leaves: &mut impl Leaves<S>,
    stack: &mut WideStack,
    search: &mut dyn Search,
) {
    if nodes.is_empty() {
        return;
    }
    let mut limit = search.limit();
    stack.start();
    while let Some(Pending { near, child }) = stack.pop(limit) {
        if child.blocks > 0 {
            leaves.visit(simd, child, near, search);
            limit = search.limit();
            continue;
        }
        let node = &nodes[child.first as usize];
        let Entered { near, mut lanes } = boxes.enter(simd, node, limit);
        let bottom = stack.len();
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let pending = Pending {
                near: near[lane],
                child: node.children[lane],
            };
            stack.insert(bottom, pending);
        }
    }
}

/// Leaves of primitives in no instance.
struct WorldLeaves<'a> {
    blocks: &'a [PrimitiveBlock],
    ray: NarrowRay,
    t_per_scaled_t: f64,
    /// Primitives that are surely missed need not be tested.
    may_leave_out: bool,
}

impl<S: Lanes> Leaves<S> for WorldLeaves<'_> {
    #[inline(always)]
    fn visit(&mut self, simd: S, leaf: Child, near: f32, search: &mut dyn Search) {
        let start = self.ray.point_at(f64::from(near) * self.t_per_scaled_t);
        for block in &self.blocks[leaf.first as usize..][..leaf.blocks as usize] {
            let mut lanes = (1u32 << block.count) - 1;
            if self.may_leave_out && block.triangles != 0 {
                let triangles = block.triangle_lanes(simd);
                let missed = surely_missed(simd, &self.ray, &start, &triangles);
                lanes &= !(missed & block.triangles);
            }
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                search.test(InstancedId::alone(block.primitives[lane]));
            }
        }
    }
}

/// Leaves of instances.
struct InstanceLeaves<'a> {
    aggregate: &'a Aggregate,
    geometry: &'a Geometry,
    ray: &'a Ray,
    slab: &'a SlabRay,
    stack: &'a mut WideStack,
}

impl<S: Lanes> Leaves<S> for InstanceLeaves<'_> {
    #[inline(always)]
    fn visit(&mut self, simd: S, leaf: Child, _near: f32, search: &mut dyn Search) {
        let instances = &self.aggregate.instances;
        let (geometry, space) = (self.geometry, &self.aggregate.space);
        for run in &instances.wide.blocks[leaf.first as usize..][..leaf.blocks as usize] {
            for instance in run.of(&instances.tree.order) {
                let instance = *instance as usize;
                let object = instances.object(geometry, instance);
                let placement = object.placement(&geometry.instances()[instance]);
                let boxes = PlacedBoxes::new(self.ray, self.slab, space, &object.space, &placement);
                let mut leaves = ObjectLeaves { object, instance };
                let nodes = &object.wide.nodes;
                visit(simd, nodes, &boxes, &mut leaves, self.stack, search);
            }
        }
    }
}

/// Leaves of an object's primitives, in an instance.
struct ObjectLeaves<'a> {
    object: &'a ObjectTree,
    instance: usize,
}

impl<S: Lanes> Leaves<S> for ObjectLeaves<'_> {
    #[inline(always)]
    fn visit(&mut self, _simd: S, leaf: Child, _near: f32, search: &mut dyn Search) {
        let ObjectTree { wide, tree, .. } = self.object;
        for run in &wide.blocks[leaf.first as usize..][..leaf.blocks as usize] {
            for primitive in run.of(&tree.order) {
                search.test(InstancedId::in_instance(self.instance, *primitive));
            }
        }
    }
}
