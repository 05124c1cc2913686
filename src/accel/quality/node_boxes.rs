//! The boxes of nodes in the world, for display.

use crate::accel::Aggregate;
use crate::accel::space::AnchorSpace;
use crate::accel::tree::{BinaryTree, Node};
use crate::geometry::Bounds;
use std::ops::RangeInclusive;

/// The box of a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeBox {
    /// The box in the world.
    pub bounds: Bounds,
    /// The number of nodes above it.
    pub depth: usize,
    /// Whether the node has no children.
    pub is_leaf: bool,
}

impl Aggregate {
    /// The boxes of the nodes at these depths, and of the leaves above them, each before those
    /// below it: of the tree over the primitives in no instance, then of the tree over the
    /// instances. Boxes of objects are in no world.
    pub fn boxes(&self, depths: RangeInclusive<usize>) -> Vec<NodeBox> {
        let mut boxes = boxes_of(&self.tree, &self.space, &depths);
        boxes.extend(boxes_of(&self.instances.tree, &self.space, &depths));
        boxes
    }
}

fn boxes_of<T>(
    tree: &BinaryTree<T>,
    space: &AnchorSpace,
    depths: &RangeInclusive<usize>,
) -> Vec<NodeBox> {
    let shown = tree.nodes().filter(|(node, depth)| {
        depths.contains(depth) || (node.is_leaf() && depth < depths.start())
    });
    let node_box = |(node, depth): (Node, usize)| NodeBox {
        bounds: space.reveal(&node.bounds.corners()),
        depth,
        is_leaf: node.is_leaf(),
    };
    shown.map(node_box).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{BuildOptions, SplitMethod};
    use crate::geometry::{Matrix, Point};
    use crate::progress::Progress;
    use crate::shape::Geometry;

    #[test]
    fn boxes_of_one_depth_hold_everything() {
        let mut geometry = Geometry::default();
        for x in 0..11 {
            let place = Matrix::translate([f64::from(x * x), 1.0, 0.0]);
            let place = geometry.add_transform(place);
            geometry.add_sphere(0.25, None, place, 1).unwrap();
        }
        let options = BuildOptions {
            method: SplitMethod::Middle,
            max_leaf: 1,
        };
        let anchor = Point::new(7.0, 7.0, 7.0);
        let aggregate = Aggregate::build(&geometry, anchor, options, Progress::SILENT);
        let depth = aggregate.statistics(&geometry).depth;
        let extent = geometry.extent();
        for last in 0..=depth {
            let boxes = aggregate.boxes(last..=last);
            let union = boxes
                .iter()
                .fold(Bounds::EMPTY, |all, one| all.union(one.bounds));
            for axis in 0..3 {
                let ends = [
                    extent.low[axis] - union.low[axis],
                    union.high[axis] - extent.high[axis],
                ];
                assert!(
                    ends.iter().all(|slack| (0.0..1e-4).contains(slack)),
                    "{ends:?}"
                );
            }
            assert!(boxes.iter().all(|one| one.depth == last || one.is_leaf));
        }
        let statistics = aggregate.statistics(&geometry);
        assert_eq!(aggregate.boxes(0..=depth).len(), statistics.nodes);
        assert_eq!(aggregate.boxes(depth..=depth).len(), statistics.leaves);
    }
}
