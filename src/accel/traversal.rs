//! One ray through the tree.

use super::Aggregate;
use super::aggregate::MAX_DEPTH;
use super::anchor_space::SlabRay;
use super::node::Node;
use crate::geometry::{Bounds, Ray};
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

/// Children that wait, farthest first. Each level of the tree leaves one at most.
struct Stack {
    waiting: [(f32, u32, bool); MAX_DEPTH + 1],
    len: usize,
}

/// The traversal of one ray.
struct Traversal<'a, const COUNTED: bool> {
    aggregate: &'a Aggregate,
    shapes: &'a Shapes,
    ray: &'a Ray,
    slab: SlabRay,
    best: Option<Hit>,
    /// The `t` of the best hit in the units of the slab test: what is entered later is culled.
    limit: f32,
    work: Work,
}

impl Aggregate {
    /// The nearest hit of `ray`; of several at one `t`, the primitive that comes first in the file (rule E3).
    pub fn closest_hit(&self, shapes: &Shapes, ray: &Ray) -> Option<Hit> {
        self.traverse::<false>(shapes, ray).0
    }

    /// As [`Aggregate::closest_hit`], adding to `work` what it took.
    pub fn closest_hit_counted(&self, shapes: &Shapes, ray: &Ray, work: &mut Work) -> Option<Hit> {
        let (hit, more) = self.traverse::<true>(shapes, ray);
        *work += more;
        hit
    }

    fn traverse<const COUNTED: bool>(&self, shapes: &Shapes, ray: &Ray) -> (Option<Hit>, Work) {
        let (Some(root), true) = (self.root, ray.can_hit()) else {
            return (None, Work::default());
        };
        let slab = self.space.ray(ray);
        let mut traversal = Traversal::<COUNTED> {
            aggregate: self,
            shapes,
            ray,
            slab,
            best: None,
            limit: f32::INFINITY,
            work: Work::default(),
        };
        traversal.run(root);
        (traversal.best, traversal.work)
    }
}

impl<const COUNTED: bool> Traversal<'_, COUNTED> {
    fn run(&mut self, root: Node) {
        let mut stack = Stack { waiting: [(0.0, 0, false); MAX_DEPTH + 1], len: 0 };
        let mut next = self.enter(&root).map(|_| root);
        while let Some(node) = next {
            next = if node.is_leaf() { None } else { self.nearer_child(&node, &mut stack) };
            if node.is_leaf() {
                self.test_leaf(&node);
            }
            if next.is_none() {
                next = self.pop(&mut stack);
            }
        }
    }

    #[inline]
    fn enter(&mut self, node: &Node) -> Option<f32> {
        if COUNTED {
            self.work.nodes += 1;
        }
        self.slab.enter(&node.bounds, self.limit)
    }

    /// The child that is entered first; the other one waits.
    #[inline]
    fn nearer_child(&mut self, node: &Node, stack: &mut Stack) -> Option<Node> {
        let [left, right] = &self.aggregate.below[node.first as usize].0;
        match (self.enter(left), self.enter(right)) {
            (Some(to_left), Some(to_right)) => {
                let right_first = to_right < to_left;
                let (nearer, to_farther) = if right_first { (right, to_left) } else { (left, to_right) };
                stack.waiting[stack.len] = (to_farther, node.first, !right_first);
                stack.len += 1;
                Some(*nearer)
            }
            (Some(_), None) => Some(*left),
            (None, Some(_)) => Some(*right),
            (None, None) => None,
        }
    }

    /// The nearest waiting node that a better hit has not overtaken.
    #[inline]
    fn pop(&mut self, stack: &mut Stack) -> Option<Node> {
        while stack.len > 0 {
            stack.len -= 1;
            let (near, children, right) = stack.waiting[stack.len];
            if near <= self.limit {
                return Some(self.aggregate.below[children as usize].0[usize::from(right)]);
            }
        }
        None
    }

    #[inline]
    fn test_leaf(&mut self, leaf: &Node) {
        let first = leaf.first as usize;
        for &primitive in &self.aggregate.order[first..first + leaf.count as usize] {
            if COUNTED {
                self.work.primitives += 1;
            }
            self.test(primitive);
        }
    }

    #[inline]
    fn test(&mut self, primitive: Primitive) {
        if primitive.is_sphere() {
            let sphere = self.shapes.sphere(primitive.index());
            if let Some(t) = sphere.intersect(self.ray) {
                self.offer(t, primitive, || sphere.bounds());
            }
        } else {
            let triangle = self.shapes.triangle(primitive.index());
            if let Some(t) = triangle.intersect(self.ray) {
                self.offer(t, primitive, || triangle.bounds());
            }
        }
    }

    /// Takes a hit at `t`, if it is the best.
    ///
    /// Rounding may have placed it a little outside the primitive's box, where a tree would never have looked. A hit
    /// counts only if the ray enters that box, and not before it does; then every node around it is entered no
    /// later, and the answer is the same for every tree, and for none.
    fn offer(&mut self, t: f64, primitive: Primitive, bounds: impl FnOnce() -> Bounds) {
        if self.best.is_some_and(|best| t > best.t) {
            return;
        }
        let Some(entry) = self.slab.enter(&self.aggregate.space.enclose(&bounds()), f32::INFINITY) else {
            return;
        };
        let t = t.max(self.slab.unscaled(entry));
        let better =
            self.best.is_none_or(|best| t < best.t || (t == best.t && self.shapes.precedes(primitive, best.primitive)));
        if better {
            self.best = Some(Hit { t, primitive });
            self.limit = self.slab.scaled_limit(t);
        }
    }
}
