//! One ray through the tree.

use crate::accel::Aggregate;
use crate::accel::build::MAX_DEPTH;
use crate::accel::hit::{Hit, Work};
use crate::accel::node::{Children, PackedNode};
use crate::accel::space::SlabRay;
use crate::shape::Primitive;

/// What is done with the primitives that a ray may hit, and how far it still has to go.
pub(in crate::accel) trait Search {
    /// Tests a primitive.
    fn test(&mut self, primitive: Primitive);

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
pub(in crate::accel) struct Stack {
    waiting: [Waiting; MAX_DEPTH + 1],
    len: usize,
}

/// Walks down the tree, the nearer child first, and has `search` test what the ray may hit. The tree is not empty.
#[inline]
pub(in crate::accel) fn traverse<const COUNTED: bool, S: Search>(
    aggregate: &Aggregate,
    slab: &SlabRay,
    mut search: S,
    stack: &mut Stack,
    work: &mut Work,
) -> Option<Hit> {
    let root = aggregate.root.as_ref()?;
    if COUNTED {
        work.nodes += 1;
    }
    slab.enter(&root.bounds.corners())?;
    let mut next = Some((root.first, root.count));
    stack.len = 0;
    while let Some((first, count)) = next {
        next = if count > 0 {
            if COUNTED {
                work.primitives += u64::from(count);
            }
            let first = first as usize;
            aggregate.order[first..first + count as usize].iter().for_each(|primitive| search.test(*primitive));
            None
        } else {
            if COUNTED {
                work.nodes += 2;
            }
            nearer_child(&aggregate.below[first as usize], slab, search.limit(), stack)
        };
        next = next.or_else(|| stack.pop(search.limit()));
    }
    search.into_hit()
}

/// The child that is entered first, if any is before `limit`; the other one waits.
#[inline]
fn nearer_child(children: &Children, slab: &SlabRay, limit: f32, stack: &mut Stack) -> Option<(u32, u32)> {
    let [left, right] = &children.0;
    let enter = |node: &PackedNode| slab.enter(&node.corners).filter(|near| *near <= limit);
    let child = |node: &PackedNode| Some((node.first(), node.count()));
    match (enter(left), enter(right)) {
        (Some(to_left), Some(to_right)) => {
            let right_first = to_right < to_left;
            let (nearer, farther, near) = if right_first { (right, left, to_left) } else { (left, right, to_right) };
            stack.waiting[stack.len] = Waiting { near, first: farther.first(), count: farther.count() };
            stack.len += 1;
            child(nearer)
        }
        (Some(_), None) => child(left),
        (None, Some(_)) => child(right),
        (None, None) => None,
    }
}

impl Stack {
    pub(in crate::accel) fn new() -> Stack {
        let nobody = Waiting { near: 0.0, first: 0, count: 0 };
        Stack { waiting: [nobody; MAX_DEPTH + 1], len: 0 }
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
