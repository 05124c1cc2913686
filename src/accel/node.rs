//! The node that every split method fills.

use super::anchor_space::Box32;

/// A node of 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(32))]
pub(super) struct Node {
    /// Around everything below, in anchor space.
    pub(super) bounds: Box32,
    /// Of an inner node: the place of its children in the list of [`Children`]. Of a leaf: where its primitives
    /// begin in the aggregate's order.
    pub(super) first: u32,
    /// Primitives of a leaf; 0 tells an inner node.
    pub(super) count: u32,
}

const _: () = assert!(size_of::<Node>() == 32);

impl Node {
    /// A leaf with `count > 0` primitives.
    pub(super) fn leaf(bounds: Box32, first: u32, count: u32) -> Node {
        debug_assert!(count > 0);
        Node { bounds, first, count }
    }

    /// An inner node with its children at place `first`.
    pub(super) fn inner(bounds: Box32, first: u32) -> Node {
        Node { bounds, first, count: 0 }
    }

    /// Whether the node has primitives and no children.
    pub(super) fn is_leaf(&self) -> bool {
        self.count > 0
    }

    /// The same node where its children lie `by` places further on.
    pub(super) fn shifted(mut self, by: usize) -> Node {
        if !self.is_leaf() {
            self.first += by as u32;
        }
        self
    }
}

/// The two children of an inner node, in one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct Children(pub(super) [Node; 2]);

const _: () = assert!(size_of::<Children>() == 64);

impl Children {
    /// Holds a place until both children are known.
    pub(super) const PLACEHOLDER: Children =
        Children([Node { bounds: Box32 { low: [0.0; 3], high: [0.0; 3] }, first: 0, count: 0 }; 2]);

    /// The same children in a list in which everything below them lies `by` places further on.
    pub(super) fn shifted(self, by: usize) -> Children {
        Children(self.0.map(|node| node.shifted(by)))
    }
}

/// A finished part of a tree: its root, and all below it in depth-first order.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Subtree {
    pub(super) root: Node,
    pub(super) below: Vec<Children>,
}

impl Subtree {
    /// Puts two subtrees under one root.
    pub(super) fn join(left: Subtree, right: Subtree) -> Subtree {
        let root = Node::inner(left.root.bounds.union(&right.root.bounds), 0);
        let right_base = 1 + left.below.len();
        let mut below = Vec::with_capacity(right_base + right.below.len());
        below.push(Children([left.root.shifted(1), right.root.shifted(right_base)]));
        below.extend(left.below.into_iter().map(|children| children.shifted(1)));
        below.extend(right.below.into_iter().map(|children| children.shifted(right_base)));
        Subtree { root, below }
    }
}
