//! The one top-down build, whatever the split method.

use super::box32::Box32;
use super::build_primitive::{BuildPrimitive, bounds_of};
use super::node::{Children, Node, Subtree};
use super::splitter::{Splitter, split_evenly};
use crate::progress::Progress;

/// Lists longer than this are handed to two threads. The tree does not depend on it.
const PARALLEL_SUBTREE: usize = 1 << 12;

/// Builds trees of a bounded depth.
pub(super) struct TopDown<'a> {
    pub(super) splitter: Splitter,
    /// Levels below the root at most.
    pub(super) max_depth: u32,
    pub(super) progress: Progress<'a>,
}

impl TopDown<'_> {
    /// The tree over `primitives`, which come to lie in the order of its leaves; the first of them has place `first`.
    /// The list must not be empty.
    pub(super) fn build(&self, primitives: &mut [BuildPrimitive], first: usize) -> Subtree {
        self.subtree(primitives, first, 0)
    }

    /// Recursion goes as deep as the tree, which `max_depth` bounds.
    fn subtree(&self, primitives: &mut [BuildPrimitive], first: usize, depth: u32) -> Subtree {
        if primitives.len() <= PARALLEL_SUBTREE {
            let mut below = Vec::new();
            let count = primitives.len();
            let root = self.node(primitives, first, depth, &mut below);
            self.progress.advance(count);
            return Subtree { root, below };
        }
        let bounds = bounds_of(primitives);
        match self.split(primitives, &bounds, depth) {
            None => self.leaf(bounds, first, primitives.len()),
            Some(middle) => {
                let (left, right) = primitives.split_at_mut(middle);
                let (left, right) = rayon::join(
                    || self.subtree(left, first, depth + 1),
                    || self.subtree(right, first + middle, depth + 1),
                );
                Subtree::join(left, right)
            }
        }
    }

    fn leaf(&self, bounds: Box32, first: usize, count: usize) -> Subtree {
        self.progress.advance(count);
        Subtree { root: Node::leaf(bounds, first as u32, count as u32), below: Vec::new() }
    }

    /// The node over `primitives`, with the nodes below it appended to `below`: in the order of [`Subtree::join`].
    fn node(&self, primitives: &mut [BuildPrimitive], first: usize, depth: u32, below: &mut Vec<Children>) -> Node {
        let bounds = bounds_of(primitives);
        let Some(middle) = self.split(primitives, &bounds, depth) else {
            return Node::leaf(bounds, first as u32, primitives.len() as u32);
        };
        let children = below.len();
        below.push(Children::PLACEHOLDER);
        let (left, right) = primitives.split_at_mut(middle);
        let left = self.node(left, first, depth + 1, below);
        let right = self.node(right, first + middle, depth + 1, below);
        below[children] = Children::new(&left, &right);
        Node::inner(bounds, children as u32)
    }

    fn split(&self, primitives: &mut [BuildPrimitive], bounds: &Box32, depth: u32) -> Option<usize> {
        // Halving from here on just ends at the deepest level allowed.
        let levels_needed = usize::BITS - (primitives.len().max(1) - 1).leading_zeros();
        if depth + levels_needed >= self.max_depth && primitives.len() > self.splitter.max_leaf {
            return Some(split_evenly(primitives));
        }
        self.splitter.split(primitives, bounds)
    }
}
