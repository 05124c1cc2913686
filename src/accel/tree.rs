//! A binary tree as every build leaves it.

use super::builder::{BuildOptions, BuildPrimitive, build_tree};
use super::node::{Children, Node, Subtree};
use super::statistics::walk;
use crate::progress::Progress;

/// A tree over things with boxes. It refers to them; they stay where they are.
#[derive(Debug, PartialEq)]
pub(super) struct Tree<T> {
    /// `None` where there is nothing.
    pub(super) root: Option<Node>,
    pub(super) below: Vec<Children>,
    /// What is in the leaves, in their order.
    pub(super) order: Vec<T>,
}

impl<T> Tree<T> {
    /// Builds over `primitives`, whose bits `of_bits` understands. `progress` counts them.
    pub(super) fn build(
        primitives: Vec<BuildPrimitive>,
        options: BuildOptions,
        progress: Progress,
        of_bits: fn(u32) -> T,
    ) -> Tree<T> {
        if primitives.is_empty() {
            return Tree {
                root: None,
                below: Vec::new(),
                order: Vec::new(),
            };
        }
        let (Subtree { root, below }, order) = build_tree(primitives, options, progress);
        Tree {
            root: Some(root),
            below,
            order: order.into_iter().map(of_bits).collect(),
        }
    }

    /// All nodes with their depths, each before its children.
    pub(super) fn nodes(&self) -> impl Iterator<Item = (Node, usize)> + '_ {
        self.root
            .into_iter()
            .flat_map(|root| walk(root, &self.below))
    }

    /// What a leaf holds.
    pub(super) fn in_leaf(&self, leaf: &Node) -> &[T] {
        &self.order[leaf.first as usize..][..leaf.count as usize]
    }

    /// Bytes that the tree takes.
    pub(super) fn bytes(&self) -> usize {
        let root = if self.root.is_some() {
            size_of::<Node>()
        } else {
            0
        };
        root + size_of_val(&self.below[..]) + size_of_val(&self.order[..])
    }
}
