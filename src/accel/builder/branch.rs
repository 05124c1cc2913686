//! Joins the subtrees that several threads build.

use crate::accel::tree::{Children, Node, Subtree};
use crate::parallel::CollectVec;
use rayon::prelude::*;

/// Two threads share the copying of more nodes.
const PARALLEL: usize = 1 << 11;

/// A tree in parts. They are joined when all are finished, so that each node moves once.
#[derive(Debug)]
pub(super) enum Branch {
    /// A finished part.
    Part(Subtree),
    /// A node above two others.
    Fork {
        sides: Box<[Branch; 2]>,
        /// The number of inner nodes.
        len: usize,
    },
}

impl Branch {
    /// A node above `left` and `right`.
    pub(super) fn fork(left: Branch, right: Branch) -> Branch {
        Branch::Fork {
            len: 1 + left.len() + right.len(),
            sides: Box::new([left, right]),
        }
    }

    /// Joins all parts. Recursion goes as deep as the forks.
    pub(super) fn into_subtree(self) -> Subtree {
        if let Branch::Part(subtree) = self {
            return subtree;
        }
        let places = (0..self.len()).into_par_iter().with_min_len(PARALLEL);
        let mut below: Vec<Children> = places.map(|_| Children::PLACEHOLDER).collect_vec();
        let root = self.write_to(&mut below, 0);
        Subtree { root, below }
    }

    /// The number of inner nodes.
    fn len(&self) -> usize {
        match self {
            Branch::Part(subtree) => subtree.below.len(),
            Branch::Fork { len, .. } => *len,
        }
    }

    /// Writes all nodes to `below`, whose first index is `first`, and returns the root.
    fn write_to(self, below: &mut [Children], first: usize) -> Node {
        match self {
            Branch::Part(subtree) => {
                for (place, children) in below.iter_mut().zip(&subtree.below) {
                    *place = children.shifted(first);
                }
                subtree.root.shifted(first)
            }
            Branch::Fork { sides, len } => {
                let [left, right] = *sides;
                let (place, below) = below.split_first_mut().expect("a place for each node");
                let right_first = first + 1 + left.len();
                let (left_below, right_below) = below.split_at_mut(left.len());
                let write_left = || left.write_to(left_below, first + 1);
                let write_right = || right.write_to(right_below, right_first);
                let (left, right) = match len > PARALLEL {
                    true => rayon::join(write_left, write_right),
                    false => (write_left(), write_right()),
                };
                *place = Children::new(&left, &right);
                Node::inner(left.bounds.union(&right.bounds), first as u32)
            }
        }
    }
}
