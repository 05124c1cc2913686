//! The traversal of the binary trees by one ray, which costs and baseline kernels are defined by.

use super::search::Search;
use crate::accel::Aggregate;
use crate::accel::hit::TraversalCounts;
use crate::accel::instance::{ObjectTree, Placement};
use crate::accel::space::{AnchorSpace, Corners, SlabRay};
use crate::accel::tree::{BinaryTree, Children, MAX_DEPTH, PackedNode};
use crate::shape::{Geometry, InstancedId};

/// A child to visit, which the ray enters at `near`.
#[derive(Clone, Copy)]
struct Pending {
    near: f32,
    first: u32,
    count: u32,
}

/// The children to visit, farthest first: up to one for each level of the tree.
pub(crate) struct BinaryStack {
    pending: [Pending; MAX_DEPTH + 1],
    len: usize,
}

/// The stacks for the world's trees and for an object's tree.
pub(crate) struct BinaryStacks {
    world: BinaryStack,
    object: BinaryStack,
}

impl BinaryStacks {
    pub(crate) fn new() -> BinaryStacks {
        BinaryStacks {
            world: BinaryStack::new(),
            object: BinaryStack::new(),
        }
    }
}

/// Traverses the trees of an aggregate over `geometry` and lets `search` test what the ray may hit.
#[inline]
pub(crate) fn traverse<const COUNTED: bool, S: Search>(
    aggregate: &Aggregate,
    geometry: &Geometry,
    slab: &SlabRay,
    search: &mut S,
    stacks: &mut BinaryStacks,
    counts: &mut TraversalCounts,
) {
    let BinaryStacks { world, object } = stacks;
    let mut traversal = Traversal::<COUNTED, S> {
        slab,
        search,
        counts,
    };
    let enter = |corners: &Corners| slab.enter(corners);
    traversal.visit_tree(&aggregate.tree, enter, world, |traversal, primitives| {
        traversal.count_primitives(primitives.len());
        primitives
            .iter()
            .for_each(|primitive| traversal.search.test(InstancedId::alone(*primitive)));
    });
    let instances = &aggregate.instances;
    traversal.visit_tree(&instances.tree, enter, world, |traversal, leaf| {
        for instance in leaf {
            let instance = *instance as usize;
            traversal.visit_instance(
                instances.object(geometry, instance),
                &aggregate.space,
                geometry,
                instance,
                object,
            );
        }
    });
}

/// The traversal of one ray.
struct Traversal<'a, const COUNTED: bool, S> {
    slab: &'a SlabRay,
    search: &'a mut S,
    counts: &'a mut TraversalCounts,
}

impl<const COUNTED: bool, S: Search> Traversal<'_, COUNTED, S> {
    /// Traverses a tree, the nearer child first, and calls `visit` with the items of leaves.
    /// `enter` returns where the ray enters a box.
    #[inline]
    fn visit_tree<T>(
        &mut self,
        tree: &BinaryTree<T>,
        enter: impl Fn(&Corners) -> Option<f32>,
        stack: &mut BinaryStack,
        mut visit: impl FnMut(&mut Self, &[T]),
    ) {
        let Some(root) = tree.root.as_ref() else {
            return;
        };
        self.count_nodes(1);
        if enter(&root.bounds.corners()).is_none_or(|near| near > self.search.limit()) {
            return;
        }
        let mut next = Some((root.first, root.count));
        stack.len = 0;
        while let Some((first, count)) = next {
            next = if count > 0 {
                visit(self, &tree.order[first as usize..][..count as usize]);
                None
            } else {
                self.count_nodes(2);
                nearer_child(
                    &tree.below[first as usize],
                    &enter,
                    self.search.limit(),
                    stack,
                )
            };
            next = next.or_else(|| stack.pop(self.search.limit()));
        }
    }

    /// Traverses the tree of an instance's object. Each box is transformed to the world.
    fn visit_instance(
        &mut self,
        object: &ObjectTree,
        space: &AnchorSpace,
        geometry: &Geometry,
        instance: usize,
        stack: &mut BinaryStack,
    ) {
        let placement: Placement = object.placement(&geometry.instances()[instance]);
        let slab = self.slab;
        let enter = |corners: &Corners| {
            let in_world = placement.enclose(&object.space.reveal(corners));
            slab.enter(&space.enclose(&in_world).corners())
        };
        self.visit_tree(&object.tree, enter, stack, |traversal, primitives| {
            traversal.count_primitives(primitives.len());
            primitives.iter().for_each(|primitive| {
                traversal
                    .search
                    .test(InstancedId::in_instance(instance, *primitive))
            });
        });
    }

    #[inline]
    fn count_nodes(&mut self, count: u64) {
        if COUNTED {
            self.counts.nodes += count;
        }
    }

    #[inline]
    fn count_primitives(&mut self, count: usize) {
        if COUNTED {
            self.counts.primitives += count as u64;
        }
    }
}

/// The child that is entered first, if one is entered before `limit`. The other one goes to the
/// stack.
#[inline]
fn nearer_child(
    children: &Children,
    enter: impl Fn(&Corners) -> Option<f32>,
    limit: f32,
    stack: &mut BinaryStack,
) -> Option<(u32, u32)> {
    let [left, right] = &children.0;
    let enter = |node: &PackedNode| enter(&node.corners).filter(|near| *near <= limit);
    let child = |node: &PackedNode| Some((node.first(), node.count()));
    match (enter(left), enter(right)) {
        (Some(to_left), Some(to_right)) => {
            let right_first = to_right < to_left;
            let (nearer, farther, near) = if right_first {
                (right, left, to_left)
            } else {
                (left, right, to_right)
            };
            stack.pending[stack.len] = Pending {
                near,
                first: farther.first(),
                count: farther.count(),
            };
            stack.len += 1;
            child(nearer)
        }
        (Some(_), None) => child(left),
        (None, Some(_)) => child(right),
        (None, None) => None,
    }
}

impl BinaryStack {
    fn new() -> BinaryStack {
        let none = Pending {
            near: 0.0,
            first: 0,
            count: 0,
        };
        BinaryStack {
            pending: [none; MAX_DEPTH + 1],
            len: 0,
        }
    }

    /// The nearest child on the stack that is entered before `limit`.
    #[inline]
    fn pop(&mut self, limit: f32) -> Option<(u32, u32)> {
        while self.len > 0 {
            self.len -= 1;
            let Pending { near, first, count } = self.pending[self.len];
            if near <= limit {
                return Some((first, count));
            }
        }
        None
    }
}
