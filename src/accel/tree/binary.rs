//! The binary tree that the builder produces and counted rays traverse.

use super::node::{Children, Node};

/// No tree is deeper, so no traversal needs a longer stack: 64 levels of free choice, then halving.
pub(crate) const MAX_DEPTH: usize = 96;

/// A tree over items with boxes. It refers to them by number; they stay where they are.
#[derive(Debug, PartialEq)]
pub(crate) struct BinaryTree<T> {
    /// `None` for a tree over nothing.
    pub(crate) root: Option<Node>,
    pub(crate) below: Vec<Children>,
    /// The items of the leaves, leaf by leaf.
    pub(crate) order: Vec<T>,
}

impl<T> BinaryTree<T> {
    /// A tree over nothing.
    pub(crate) const EMPTY: BinaryTree<T> = BinaryTree {
        root: None,
        below: Vec::new(),
        order: Vec::new(),
    };

    /// Walks all nodes with their depths, each before its children.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = (Node, usize)> + '_ {
        let mut stack: Vec<(Node, usize)> = self.root.into_iter().map(|root| (root, 0)).collect();
        std::iter::from_fn(move || {
            let (node, depth) = stack.pop()?;
            if !node.is_leaf() {
                let children = &self.below[node.first as usize];
                stack.push((children.node(1), depth + 1));
                stack.push((children.node(0), depth + 1));
            }
            Some((node, depth))
        })
    }

    /// The items of a leaf.
    pub(crate) fn in_leaf(&self, leaf: &Node) -> &[T] {
        &self.order[leaf.first as usize..][..leaf.count as usize]
    }

    /// The memory of the tree in bytes.
    pub(crate) fn bytes(&self) -> usize {
        let nodes = size_of_val(self.root.as_slice()) + size_of_val(&self.below[..]);
        nodes + size_of_val(&self.order[..])
    }
}
