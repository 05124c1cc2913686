//! The node that every split method fills.

use super::space::{Box32, Corners};

/// A node as it is built and walked over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    /// Around everything below, in anchor space.
    pub(super) bounds: Box32,
    /// Of an inner node: the place of its children in the list of [`Children`]. Of a leaf: where its primitives
    /// begin in the aggregate's order.
    pub(super) first: u32,
    /// Primitives of a leaf; 0 tells an inner node.
    pub(super) count: u32,
}

impl Node {
    /// A leaf with `count > 0` primitives.
    pub(super) fn leaf(bounds: Box32, first: u32, count: u32) -> Node {
        debug_assert!(count > 0);
        Node {
            bounds,
            first,
            count,
        }
    }

    /// An inner node with its children at place `first`.
    pub(super) fn inner(bounds: Box32, first: u32) -> Node {
        Node {
            bounds,
            first,
            count: 0,
        }
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

/// The two children of an inner node as they are stored: in one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct Children(pub(super) [PackedNode; 2]);

/// A node of 32 bytes: two registers of four lanes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PackedNode {
    /// The corners of the box; behind the low one the bits of [`Node::first`], behind the high one those of
    /// [`Node::count`].
    pub(super) corners: Corners,
}

const _: () = assert!(size_of::<Children>() == 64);

impl PackedNode {
    pub(super) fn first(&self) -> u32 {
        self.corners[0][3].to_bits()
    }

    pub(super) fn count(&self) -> u32 {
        self.corners[1][3].to_bits()
    }

    fn pack(node: &Node) -> PackedNode {
        let mut corners = node.bounds.corners();
        (corners[0][3], corners[1][3]) = (f32::from_bits(node.first), f32::from_bits(node.count));
        PackedNode { corners }
    }

    fn unpack(&self) -> Node {
        let [[x0, y0, z0, _], [x1, y1, z1, _]] = self.corners;
        Node {
            bounds: Box32 {
                low: [x0, y0, z0],
                high: [x1, y1, z1],
            },
            first: self.first(),
            count: self.count(),
        }
    }
}

impl Children {
    /// Holds a place until both children are known.
    pub(super) const PLACEHOLDER: Children = Children(
        [PackedNode {
            corners: [[0.0; 4]; 2],
        }; 2],
    );

    pub(super) fn new(left: &Node, right: &Node) -> Children {
        Children([PackedNode::pack(left), PackedNode::pack(right)])
    }

    /// The left (0) or the right (1) child.
    pub(super) fn node(&self, side: usize) -> Node {
        self.0[side].unpack()
    }

    /// The same children in a list in which everything below them lies `by` places further on.
    pub(super) fn shifted(&self, by: usize) -> Children {
        Children::new(&self.node(0).shifted(by), &self.node(1).shifted(by))
    }
}

/// A finished part of a tree: its root, and all below it in depth-first order.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Subtree {
    pub(super) root: Node,
    pub(super) below: Vec<Children>,
}
