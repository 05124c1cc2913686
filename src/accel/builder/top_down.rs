//! The top-down build, the same for all split methods.

use super::branch::Branch;
use super::build_primitive::{BuildPrimitive, bounds_of};
use super::splitter::{Splitter, split_evenly};
use crate::accel::tree::{Children, Node, Subtree};
use crate::progress::Progress;

/// Two threads share longer lists. The tree does not depend on this.
const PARALLEL_SUBTREE: usize = 1 << 10;

/// Builds trees of a bounded depth.
pub(super) struct TopDown<'a> {
    pub(super) splitter: Splitter,
    /// The largest number of levels below the root.
    pub(super) max_depth: u32,
    pub(super) progress: Progress<'a>,
}

impl TopDown<'_> {
    /// Builds the tree over `primitives`, which must not be empty, and sorts them in the order of
    /// its leaves. The first primitive gets index `first`.
    pub(super) fn build(&self, primitives: &mut [BuildPrimitive], first: usize) -> Subtree {
        self.branch(primitives, first, 0).into_subtree()
    }

    /// Recursion goes as deep as the tree, which `max_depth` bounds.
    fn branch(&self, primitives: &mut [BuildPrimitive], first: usize, depth: u32) -> Branch {
        if primitives.len() > PARALLEL_SUBTREE
            && let Some(middle) = self.split(primitives, depth)
        {
            let (left, right) = primitives.split_at_mut(middle);
            let (left, right) = rayon::join(
                || self.branch(left, first, depth + 1),
                || self.branch(right, first + middle, depth + 1),
            );
            return Branch::fork(left, right);
        }
        let count = primitives.len();
        let mut below = Vec::with_capacity(self.splitter.leaf_size.leaves(count));
        let root = self.node(primitives, first, depth, &mut below);
        self.progress.advance(count);
        Branch::Part(Subtree { root, below })
    }

    /// The node over `primitives`. Appends the nodes below it to `below`, depth first.
    fn node(
        &self,
        primitives: &mut [BuildPrimitive],
        first: usize,
        depth: u32,
        below: &mut Vec<Children>,
    ) -> Node {
        let Some(middle) = self.split(primitives, depth) else {
            return Node::leaf(bounds_of(primitives), first as u32, primitives.len() as u32);
        };
        let children = below.len();
        below.push(Children::PLACEHOLDER);
        let (left, right) = primitives.split_at_mut(middle);
        let left = self.node(left, first, depth + 1, below);
        let right = self.node(right, first + middle, depth + 1, below);
        below[children] = Children::new(&left, &right);
        Node::inner(left.bounds.union(&right.bounds), children as u32)
    }

    fn split(&self, primitives: &mut [BuildPrimitive], depth: u32) -> Option<usize> {
        // Halving from here on ends exactly at the deepest level allowed.
        let levels_needed = usize::BITS - (primitives.len().max(1) - 1).leading_zeros();
        if depth + levels_needed >= self.max_depth && primitives.len() > self.splitter.leaf_size.0 {
            return Some(split_evenly(primitives));
        }
        self.splitter.split(primitives)
    }
}
