//! Tree statistics: nodes, depth, SAH cost, bytes.

use crate::accel::Aggregate;
use crate::accel::tree::{BinaryTree, Node};
use crate::shape::Geometry;

/// The cost of visiting a node, in units of testing a primitive.
pub(super) const NODE_COST: f64 = 1.0;

/// Counts and costs of all trees of an aggregate: that of the primitives in no instance, that of
/// the instances, and those of the objects, each counted once.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    /// Inner nodes and leaves.
    pub nodes: usize,
    /// Nodes that hold primitives or instances.
    pub leaves: usize,
    /// Steps from the root to the deepest leaf, including the trees of objects below instances.
    pub depth: usize,
    /// The expected cost of a random ray that meets the box around everything, by the surface area
    /// heuristic (MacDonald and Booth, 1990). A visited node costs 1, a tested primitive 1, an
    /// instance as much as its object.
    pub sah_cost: f64,
    /// Bytes of nodes and of the order of primitives.
    pub bytes: usize,
}

impl Aggregate {
    /// Counts and costs of the trees.
    pub fn statistics(&self, geometry: &Geometry) -> Statistics {
        let TreeStatistics {
            own,
            instances,
            objects,
        } = self.statistics_by_tree(geometry);
        let deepest = objects.iter().map(|object| object.depth).max().unwrap_or(0);
        let all = || objects.iter().chain([&own, &instances]);
        Statistics {
            nodes: all().map(|tree| tree.nodes).sum(),
            leaves: all().map(|tree| tree.leaves).sum(),
            depth: own.depth.max(instances.depth + deepest),
            sah_cost: joint_cost([
                (&self.tree.root, own.sah_cost),
                (&self.instances.tree.root, instances.sah_cost),
            ]),
            bytes: self.tree.bytes() + self.wide.bytes() + self.instances.bytes(),
        }
    }

    /// The statistics of each tree.
    pub(super) fn statistics_by_tree(&self, geometry: &Geometry) -> TreeStatistics {
        let instances = &self.instances;
        let object_statistics = instances.objects.iter().map(|object| match object {
            Some(object) => statistics_of(&object.tree, |leaf| leaf.count.into()),
            None => Statistics::default(),
        });
        let objects: Vec<Statistics> = object_statistics.collect();
        let cost_of_instance =
            |instance: &u32| objects[geometry.instances()[*instance as usize].object()].sah_cost;
        let upper = statistics_of(&instances.tree, |leaf| {
            let leaf = instances.tree.in_leaf(leaf);
            leaf.iter().map(cost_of_instance).sum()
        });
        TreeStatistics {
            own: statistics_of(&self.tree, |leaf| leaf.count.into()),
            instances: upper,
            objects,
        }
    }
}

/// The statistics of each tree of an aggregate, without their bytes.
pub(super) struct TreeStatistics {
    /// The tree over the primitives in no instance.
    pub(super) own: Statistics,
    /// The tree over the instances.
    pub(super) instances: Statistics,
    /// The trees of the objects; empty ones of objects that nothing shows.
    pub(super) objects: Vec<Statistics>,
}

/// The statistics of one tree, without its bytes.
fn statistics_of<T>(tree: &BinaryTree<T>, leaf_cost: impl Fn(&Node) -> f64) -> Statistics {
    let Some(root) = tree.root else {
        return Statistics::default();
    };
    let mut statistics = Statistics::default();
    let mut cost = 0.0;
    for (node, depth) in tree.nodes() {
        statistics.nodes += 1;
        statistics.leaves += usize::from(node.is_leaf());
        statistics.depth = statistics.depth.max(depth);
        let visit = if node.is_leaf() {
            leaf_cost(&node)
        } else {
            NODE_COST
        };
        cost += f64::from(node.bounds.half_area()) * visit;
    }
    statistics.sah_cost = cost / f64::from(root.bounds.half_area());
    statistics
}

/// The cost of a ray that meets the box around two trees, given the costs of rays that meet the box
/// of each.
fn joint_cost(trees: [(&Option<Node>, f64); 2]) -> f64 {
    match trees {
        [(Some(a), cost_a), (Some(b), cost_b)] => {
            let area = |node: &Node| f64::from(node.bounds.half_area());
            (area(a) * cost_a + area(b) * cost_b) / f64::from(a.bounds.union(&b.bounds).half_area())
        }
        [(_, cost_a), (_, cost_b)] => cost_a + cost_b,
    }
}
