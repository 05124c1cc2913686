//! Nodes of a binary tree, as every split method fills them.

use crate::accel::space::{Box32, Corners};

/// A node as it is built and traversed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Node {
    /// Encloses everything below the node, in anchor space.
    pub(crate) bounds: Box32,
    /// For an inner node the index of its children in the list of [`Children`]. For a leaf the
    /// index of its first primitive in the tree's order.
    pub(crate) first: u32,
    /// Primitives of a leaf; 0 for an inner node.
    pub(crate) count: u32,
}

impl Node {
    /// A leaf with `count > 0` primitives.
    pub(crate) fn leaf(bounds: Box32, first: u32, count: u32) -> Node {
        debug_assert!(count > 0);
        Node {
            bounds,
            first,
            count,
        }
    }

    /// An inner node with its children at index `first`.
    pub(crate) fn inner(bounds: Box32, first: u32) -> Node {
        Node {
            bounds,
            first,
            count: 0,
        }
    }

    /// Tests whether the node has primitives and no children.
    pub(crate) fn is_leaf(&self) -> bool {
        self.count > 0
    }

    /// The same node after its children moved back by `by` indices.
    pub(crate) fn shifted(mut self, by: usize) -> Node {
        if !self.is_leaf() {
            self.first += by as u32;
        }
        self
    }
}

/// The two children of an inner node, stored in one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(crate) struct Children(pub(crate) [PackedNode; 2]);

/// A node of 32 bytes: two registers of four lanes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PackedNode {
    /// The corners of the box. The fourth lane of the low corner holds the bits of
    /// [`Node::first`], that of the high corner the bits of [`Node::count`].
    pub(crate) corners: Corners,
}

const _: () = assert!(size_of::<Children>() == 64);

impl PackedNode {
    pub(crate) fn first(&self) -> u32 {
        self.corners[0][3].to_bits()
    }

    pub(crate) fn count(&self) -> u32 {
        self.corners[1][3].to_bits()
    }

    fn pack(node: &Node) -> PackedNode {
        let mut corners = node.bounds.corners();
        (corners[0][3], corners[1][3]) = (f32::from_bits(node.first), f32::from_bits(node.count));
        PackedNode { corners }
    }

    fn unpack(&self) -> Node {
        let [[x0, y0, z0, _], [x1, y1, z1, _]] = self.corners;
        let bounds = Box32 {
            low: [x0, y0, z0],
            high: [x1, y1, z1],
        };
        Node {
            bounds,
            first: self.first(),
            count: self.count(),
        }
    }
}

impl Children {
    /// Reserves an entry until both children are known.
    pub(crate) const PLACEHOLDER: Children = Children(
        [PackedNode {
            corners: [[0.0; 4]; 2],
        }; 2],
    );

    pub(crate) fn new(left: &Node, right: &Node) -> Children {
        Children([PackedNode::pack(left), PackedNode::pack(right)])
    }

    /// The left (0) or the right (1) child.
    pub(crate) fn node(&self, side: usize) -> Node {
        self.0[side].unpack()
    }

    /// The same children in a list where everything below them has moved back by `by` indices.
    pub(crate) fn shifted(&self, by: usize) -> Children {
        Children::new(&self.node(0).shifted(by), &self.node(1).shifted(by))
    }
}

/// A finished subtree: its root, and the nodes below in depth-first order.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Subtree {
    pub(crate) root: Node,
    pub(crate) below: Vec<Children>,
}
