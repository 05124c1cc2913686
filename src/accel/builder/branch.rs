//! Joins the subtrees that several threads build.

use crate::accel::tree::{Children, Node, Subtree};

/// A tree in parts. They are joined when all are finished, so that each node moves once.
#[derive(Debug)]
pub(super) enum Branch {
    /// A finished part.
    Part(Subtree),
    /// A node above two others.
    Fork(Box<[Branch; 2]>),
}

impl Branch {
    /// A node above `left` and `right`.
    pub(super) fn fork(left: Branch, right: Branch) -> Branch {
        Branch::Fork(Box::new([left, right]))
    }

    /// Joins all parts. Recursion goes as deep as the forks.
    pub(super) fn into_subtree(self) -> Subtree {
        if let Branch::Part(subtree) = self {
            return subtree;
        }
        let mut below = Vec::with_capacity(self.len());
        let root = self.append_to(&mut below);
        Subtree { root, below }
    }

    /// The number of inner nodes.
    fn len(&self) -> usize {
        match self {
            Branch::Part(subtree) => subtree.below.len(),
            Branch::Fork(sides) => 1 + sides[0].len() + sides[1].len(),
        }
    }

    fn append_to(self, below: &mut Vec<Children>) -> Node {
        let first = below.len();
        match self {
            Branch::Part(subtree) => {
                below.extend(subtree.below.iter().map(|children| children.shifted(first)));
                subtree.root.shifted(first)
            }
            Branch::Fork(sides) => {
                below.push(Children::PLACEHOLDER);
                let [left, right] = sides.map(|side| side.append_to(below));
                below[first] = Children::new(&left, &right);
                Node::inner(left.bounds.union(&right.bounds), first as u32)
            }
        }
    }
}
