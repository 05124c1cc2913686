//! What trees are like.

use super::Aggregate;
use super::node::{Children, Node};
use super::tree::Tree;
use crate::shape::Geometry;

/// What visiting a node costs, in units of testing a primitive.
pub(super) const NODE_COST: f64 = 1.0;

/// Counts and costs of the trees of an aggregate: that of the primitives in no instance, that of the instances, and those of
/// the objects, each once.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    /// Inner nodes and leaves.
    pub nodes: usize,
    /// Nodes that hold primitives or instances.
    pub leaves: usize,
    /// Steps from the root to the deepest leaf, on into the trees of objects.
    pub depth: usize,
    /// The expected cost of a random ray that meets the box around everything, by the surface area heuristic: a visited node
    /// counts 1, a tested primitive 1 (MacDonald and Booth, 1990), an instance as much as its object.
    pub sah_cost: f64,
    /// Bytes of nodes and of the order of primitives.
    pub bytes: usize,
}

impl Statistics {
    pub(super) fn of(aggregate: &Aggregate, geometry: &Geometry) -> Statistics {
        let instances = &aggregate.instances;
        let objects: Vec<Statistics> = instances
            .objects
            .iter()
            .map(|object| {
                object.as_ref().map_or(Statistics::default(), |object| {
                    counts(&object.tree, |leaf| leaf.count.into())
                })
            })
            .collect();
        let of_instance =
            |instance: &u32| objects[geometry.instances()[*instance as usize].object()].sah_cost;
        let own = counts(&aggregate.tree, |leaf| leaf.count.into());
        let upper = counts(&instances.tree, |leaf| {
            instances.tree.in_leaf(leaf).iter().map(of_instance).sum()
        });
        let deepest = objects.iter().map(|object| object.depth).max().unwrap_or(0);
        let sum =
            |count: fn(&Statistics) -> usize| objects.iter().chain([&own, &upper]).map(count).sum();
        Statistics {
            nodes: sum(|tree| tree.nodes),
            leaves: sum(|tree| tree.leaves),
            depth: own.depth.max(upper.depth + deepest),
            sah_cost: joint_cost([
                (&aggregate.tree.root, own.sah_cost),
                (&instances.tree.root, upper.sah_cost),
            ]),
            bytes: aggregate.tree.bytes() + aggregate.wide.bytes() + instances.bytes(),
        }
    }
}

/// Of one tree, all but the bytes.
fn counts<T>(tree: &Tree<T>, leaf_cost: impl Fn(&Node) -> f64) -> Statistics {
    let Some(root) = tree.root else {
        return Statistics::default();
    };
    let mut statistics = Statistics::default();
    let mut cost = 0.0;
    for (node, depth) in tree.nodes() {
        statistics.nodes += 1;
        statistics.leaves += usize::from(node.is_leaf());
        statistics.depth = statistics.depth.max(depth);
        let work = if node.is_leaf() {
            leaf_cost(&node)
        } else {
            NODE_COST
        };
        cost += f64::from(node.bounds.half_area()) * work;
    }
    Statistics {
        sah_cost: cost / f64::from(root.bounds.half_area()),
        ..statistics
    }
}

/// The cost of a ray that meets the box around two trees, from what each costs a ray that meets its own.
fn joint_cost(trees: [(&Option<Node>, f64); 2]) -> f64 {
    match trees {
        [(Some(a), cost_a), (Some(b), cost_b)] => {
            let area = |node: &Node| f64::from(node.bounds.half_area());
            (area(a) * cost_a + area(b) * cost_b) / f64::from(a.bounds.union(&b.bounds).half_area())
        }
        [(_, cost_a), (_, cost_b)] => cost_a + cost_b,
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
