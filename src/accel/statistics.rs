//! What a tree is like.

use super::Aggregate;
use super::node::{Children, Node};

/// What visiting a node costs, in units of testing a primitive.
const NODE_COST: f32 = 1.0;

/// Counts and costs of a tree.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    /// Inner nodes and leaves.
    pub nodes: usize,
    /// Nodes that hold primitives.
    pub leaves: usize,
    /// Steps from the root to the deepest leaf.
    pub depth: usize,
    /// The expected cost of a random ray that meets the root's box, by the surface area heuristic: a visited node
    /// counts 1, a tested primitive 1 (MacDonald and Booth, 1990).
    pub sah_cost: f64,
    /// Bytes of nodes and of the order of primitives.
    pub bytes: usize,
}

impl Statistics {
    pub(super) fn of(aggregate: &Aggregate) -> Statistics {
        let binary = size_of_val(&aggregate.below[..]) + size_of_val(&aggregate.order[..]) + size_of::<Node>();
        let bytes = binary + aggregate.wide.bytes();
        let Some(root) = aggregate.root else {
            return Statistics::default();
        };
        let mut statistics = Statistics { bytes, ..Statistics::default() };
        let mut cost = 0.0;
        for (node, depth) in walk(root, &aggregate.below) {
            statistics.nodes += 1;
            statistics.leaves += usize::from(node.is_leaf());
            statistics.depth = statistics.depth.max(depth);
            let work = if node.is_leaf() { node.count as f32 } else { NODE_COST };
            cost += f64::from(node.bounds.half_area()) * f64::from(work);
        }
        statistics.sah_cost = cost / f64::from(root.bounds.half_area());
        statistics
    }
}

/// All nodes with their depths, each before its children.
pub(super) fn walk(root: Node, below: &[Children]) -> impl Iterator<Item = (Node, usize)> + '_ {
    let mut stack = vec![(root, 0)];
    std::iter::from_fn(move || {
        let (node, depth) = stack.pop()?;
        if !node.is_leaf() {
            let children = &below[node.first as usize];
            stack.push((children.node(1), depth + 1));
            stack.push((children.node(0), depth + 1));
        }
        Some((node, depth))
    })
}
