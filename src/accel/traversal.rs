//! One ray through the tree.

use super::Aggregate;
use super::aggregate::MAX_DEPTH;
use super::anchor_space::SlabRay;
use super::node::{Children, PackedNode};
use crate::geometry::Ray;
use crate::shape::{Primitive, Shapes};

/// What a ray meets first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The parameter of the ray.
    pub t: f64,
    /// What was hit.
    pub primitive: Primitive,
}

/// What rays cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Boxes of nodes that were tested.
    pub nodes: u64,
    /// Primitives that were tested.
    pub primitives: u64,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Work) {
        self.nodes += other.nodes;
        self.primitives += other.primitives;
    }
}

/// A child that waits: it is entered at `near`.
#[derive(Clone, Copy)]
struct Waiting {
    near: f32,
    first: u32,
    count: u32,
}

/// Children that wait, farthest first. Each level of the tree leaves one at most.
struct Stack {
    waiting: [Waiting; MAX_DEPTH + 1],
    len: usize,
}

/// Casts rays, one after the other. Each thread has its own.
pub struct Tracer<'a> {
    aggregate: &'a Aggregate,
    shapes: &'a Shapes,
    stack: Stack,
}

impl<'a> Tracer<'a> {
    /// For rays through `aggregate`, which was built over `shapes`.
    pub fn new(aggregate: &'a Aggregate, shapes: &'a Shapes) -> Tracer<'a> {
        let nobody = Waiting { near: 0.0, first: 0, count: 0 };
        Tracer { aggregate, shapes, stack: Stack { waiting: [nobody; MAX_DEPTH + 1], len: 0 } }
    }

    /// The nearest hit of `ray`; of several at one `t`, the primitive that comes first in the file (rule E3).
    pub fn closest_hit(&mut self, ray: &Ray) -> Option<Hit> {
        self.trace::<false>(ray, &mut Work::default())
    }

    /// As [`Tracer::closest_hit`], adding to `work` what it took.
    pub fn closest_hit_counted(&mut self, ray: &Ray, work: &mut Work) -> Option<Hit> {
        self.trace::<true>(ray, work)
    }

    fn trace<const COUNTED: bool>(&mut self, ray: &Ray, work: &mut Work) -> Option<Hit> {
        let root = self.aggregate.root.as_ref().filter(|_| ray.can_hit())?;
        let slab = self.aggregate.space.ray(ray);
        if COUNTED {
            work.nodes += 1;
        }
        slab.enter(&root.bounds.corners())?;
        let mut nearest =
            Nearest { aggregate: self.aggregate, shapes: self.shapes, ray, slab, hit: None, limit: f32::INFINITY };
        let mut next = Some((root.first, root.count));
        self.stack.len = 0;
        while let Some((first, count)) = next {
            next = if count > 0 {
                if COUNTED {
                    work.primitives += u64::from(count);
                }
                nearest.test_leaf(first, count);
                None
            } else {
                if COUNTED {
                    work.nodes += 2;
                }
                nearest.nearer_child(&self.aggregate.below[first as usize], &mut self.stack)
            };
            next = next.or_else(|| self.stack.pop(nearest.limit));
        }
        nearest.hit
    }
}

impl Stack {
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

/// The nearest hit of a ray so far.
struct Nearest<'a> {
    aggregate: &'a Aggregate,
    shapes: &'a Shapes,
    ray: &'a Ray,
    slab: SlabRay,
    hit: Option<Hit>,
    /// The `t` of the hit in the units of the slab test: what is entered later is culled.
    limit: f32,
}

impl Nearest<'_> {
    /// The child that is entered first, if any; the other one waits.
    #[inline]
    fn nearer_child(&self, children: &Children, stack: &mut Stack) -> Option<(u32, u32)> {
        let [left, right] = &children.0;
        let enter = |node: &PackedNode| self.slab.enter(&node.corners).filter(|near| *near <= self.limit);
        let child = |node: &PackedNode| Some((node.first(), node.count()));
        match (enter(left), enter(right)) {
            (Some(to_left), Some(to_right)) => {
                let right_first = to_right < to_left;
                let (nearer, farther, near) =
                    if right_first { (right, left, to_left) } else { (left, right, to_right) };
                stack.waiting[stack.len] = Waiting { near, first: farther.first(), count: farther.count() };
                stack.len += 1;
                child(nearer)
            }
            (Some(_), None) => child(left),
            (None, Some(_)) => child(right),
            (None, None) => None,
        }
    }

    #[inline]
    fn test_leaf(&mut self, first: u32, count: u32) {
        let first = first as usize;
        for &primitive in &self.aggregate.order[first..first + count as usize] {
            if let Some(t) = self.shapes.intersect(primitive, self.ray) {
                self.offer(t, primitive);
            }
        }
    }

    /// Takes a hit at `t`, if it is the best.
    ///
    /// Rounding may have placed it a little outside the primitive's box, where a tree would never have looked. A hit
    /// counts only if the ray enters that box, and not before it does; then every node around it is entered no
    /// later, and the answer is the same for every tree, and for none.
    fn offer(&mut self, t: f64, primitive: Primitive) {
        if self.hit.is_some_and(|best| t > best.t) {
            return;
        }
        let corners = self.aggregate.space.enclose(&self.shapes.bounds(primitive)).corners();
        let Some(entry) = self.slab.enter(&corners) else { return };
        let t = t.max(self.slab.unscaled(entry));
        let better =
            self.hit.is_none_or(|best| t < best.t || (t == best.t && self.shapes.precedes(primitive, best.primitive)));
        if better {
            self.hit = Some(Hit { t, primitive });
            self.limit = self.slab.scaled_limit(t);
        }
    }
}
