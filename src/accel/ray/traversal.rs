//! One ray through the trees.

use crate::accel::Aggregate;

use crate::accel::hit::{Hit, TraversalCounts};
use crate::accel::instance::{ObjectTree, Placement};

use crate::accel::space::{AnchorSpace, Corners, SlabRay};
use crate::accel::tree::{BinaryTree, Children, MAX_DEPTH, PackedNode};
use crate::shape::{Geometry, InstancedId};

/// What is done with the primitives that a ray may hit, and how far it still has to go.
pub(crate) trait Search {
    /// Tests a primitive.
    fn test(&mut self, primitive: InstancedId);

    /// In the units of the slab test: what is entered later cannot hold a better hit.
    fn limit(&self) -> f32;

    /// Whether any primitive that was tested is hit.
    fn has_hit(&self) -> bool;

    /// The best hit of all primitives that were tested.
    fn into_hit(self) -> Option<Hit>;
}

/// A child that waits: it is entered at `near`.
#[derive(Clone, Copy)]
struct Waiting {
    near: f32,
    first: u32,
    count: u32,
}

/// Children that wait, farthest first. Each level of the tree leaves one at most.
pub(crate) struct Stack {
    waiting: [Waiting; MAX_DEPTH + 1],
    len: usize,
}

/// The stacks of the world's trees, and of an object's.
pub(crate) struct Stacks {
    world: Stack,
    object: Stack,
}

impl Stacks {
    pub(crate) fn new() -> Stacks {
        Stacks {
            world: Stack::new(),
            object: Stack::new(),
        }
    }
}

/// Walks down the trees of an aggregate over `geometry`, and has `search` test what the ray may hit.
#[inline]
pub(crate) fn traverse<const COUNTED: bool, S: Search>(
    aggregate: &Aggregate,
    geometry: &Geometry,
    slab: &SlabRay,
    mut search: S,
    stacks: &mut Stacks,
    work: &mut TraversalCounts,
) -> Option<Hit> {
    let Stacks { world, object } = stacks;
    let mut walk = Walk::<COUNTED, S> {
        slab,
        search: &mut search,
        work,
    };
    let enter = |corners: &Corners| slab.enter(corners);
    walk.down(&aggregate.tree, enter, world, |walk, primitives| {
        walk.count_primitives(primitives.len());
        primitives
            .iter()
            .for_each(|primitive| walk.search.test(InstancedId::alone(*primitive)));
    });
    let instances = &aggregate.instances;
    walk.down(&instances.tree, enter, world, |walk, leaf| {
        for instance in leaf {
            let instance = *instance as usize;
            walk.down_object(
                instances.object(geometry, instance),
                &aggregate.space,
                geometry,
                instance,
                object,
            );
        }
    });
    search.into_hit()
}

/// A ray on its way.
struct Walk<'a, const COUNTED: bool, S> {
    slab: &'a SlabRay,
    search: &'a mut S,
    work: &'a mut TraversalCounts,
}

impl<const COUNTED: bool, S: Search> Walk<'_, COUNTED, S> {
    /// Walks down a tree, the nearer child first, and hands what is in leaves to `visit`. `enter` tells where the ray enters a
    /// box, if it does.
    #[inline]
    fn down<T>(
        &mut self,
        tree: &BinaryTree<T>,
        enter: impl Fn(&Corners) -> Option<f32>,
        stack: &mut Stack,
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

    /// The tree of an object where an instance places it: each box is taken to the world.
    fn down_object(
        &mut self,
        object: &ObjectTree,
        space: &AnchorSpace,
        geometry: &Geometry,
        instance: usize,
        stack: &mut Stack,
    ) {
        let placement: Placement = object.placement(&geometry.instances()[instance]);
        let slab = self.slab;
        let enter = |corners: &Corners| {
            let in_world = placement.enclose(&object.space.reveal(corners));
            slab.enter(&space.enclose(&in_world).corners())
        };
        self.down(&object.tree, enter, stack, |walk, primitives| {
            walk.count_primitives(primitives.len());
            primitives.iter().for_each(|primitive| {
                walk.search
                    .test(InstancedId::in_instance(instance, *primitive))
            });
        });
    }

    #[inline]
    fn count_nodes(&mut self, count: u64) {
        if COUNTED {
            self.work.nodes += count;
        }
    }

    #[inline]
    fn count_primitives(&mut self, count: usize) {
        if COUNTED {
            self.work.primitives += count as u64;
        }
    }
}

/// The child that is entered first, if any is before `limit`; the other one waits.
#[inline]
fn nearer_child(
    children: &Children,
    enter: impl Fn(&Corners) -> Option<f32>,
    limit: f32,
    stack: &mut Stack,
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
            stack.waiting[stack.len] = Waiting {
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

impl Stack {
    fn new() -> Stack {
        let nobody = Waiting {
            near: 0.0,
            first: 0,
            count: 0,
        };
        Stack {
            waiting: [nobody; MAX_DEPTH + 1],
            len: 0,
        }
    }

    /// The nearest waiting child that is entered before `limit`.
    #[inline]
    fn pop(&mut self, limit: f32) -> Option<(u32, u32)> {
        while self.len > 0 {
            self.len -= 1;
            let Waiting { near, first, count } = self.waiting[self.len];
            if near <= limit {
                return Some((first, count));
            }
        }
        None
    }
}
