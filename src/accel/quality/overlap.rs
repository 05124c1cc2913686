//! How much nodes overlap surfaces that belong to other nodes.

use super::statistics::NODE_COST;
use crate::accel::Aggregate;
use crate::accel::space::Box32;
use crate::accel::tree::{BinaryTree, Node};
use crate::geometry::Point;
use crate::shape::PrimitiveId;

impl Aggregate {
    /// The cost of the nodes that contain a point of `primitive` without having that primitive
    /// below them.
    ///
    /// The mean of this over all points of all surfaces is the end-point overlap (EPO) of Aila,
    /// Karras and Laine, "On quality metrics of bounding volume hierarchies" (2013), section 3.
    /// Costs are those of [`super::Statistics::sah_cost`]. Primitives of instances do not count.
    pub fn overlap_at(&self, primitive: PrimitiveId, point: Point) -> f64 {
        let point = box_of(self.space.place(&point));
        let cost = |root| overlap(&self.tree, &root, primitive, &point).cost;
        self.tree.root.map_or(0.0, cost)
    }
}

/// The box that holds a single point.
fn box_of(point: [f32; 3]) -> Box32 {
    Box32 {
        low: point,
        high: point,
    }
}

/// The overlap of a node and of everything below it.
#[derive(Default)]
struct Overlap {
    cost: f64,
    /// Whether the primitive is below.
    is_own: bool,
}

/// Recursion is as deep as the tree.
fn overlap(
    tree: &BinaryTree<PrimitiveId>,
    node: &Node,
    primitive: PrimitiveId,
    point: &Box32,
) -> Overlap {
    if !node.bounds.contains(point) {
        return Overlap::default();
    }
    let (below, own_cost) = if node.is_leaf() {
        let is_own = tree.in_leaf(node).contains(&primitive);
        (Overlap { cost: 0.0, is_own }, f64::from(node.count))
    } else {
        let children = &tree.below[node.first as usize];
        let [left, right] =
            [0, 1].map(|side| overlap(tree, &children.node(side), primitive, point));
        let (cost, is_own) = (left.cost + right.cost, left.is_own || right.is_own);
        (Overlap { cost, is_own }, NODE_COST)
    };
    Overlap {
        cost: below.cost + if below.is_own { 0.0 } else { own_cost },
        ..below
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{BuildOptions, SplitMethod};
    use crate::geometry::Matrix;
    use crate::progress::Progress;
    use crate::shape::Geometry;

    /// Triangles side by side, and one that crosses all their boxes.
    fn aggregate(method: SplitMethod) -> (Aggregate, Vec<Point>) {
        let corner = |x: f64, y: f64| Point::new(x, y, 1.0);
        let mut vertices: Vec<Point> = (0..8)
            .flat_map(|i| {
                [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5)].map(|(x, y)| corner(x + f64::from(i), y))
            })
            .collect();
        vertices.extend([corner(0.0, 0.25), corner(8.0, 0.25), corner(8.0, 0.3)]);
        let triangles = (0..9).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mut geometry = Geometry::default();
        geometry
            .add_mesh(vertices.clone(), triangles, &Matrix::IDENTITY, 1)
            .unwrap();
        let options = BuildOptions {
            method,
            max_leaf: 1,
        };
        (
            Aggregate::build(&geometry, corner(0.0, 0.0), options, Progress::SILENT),
            vertices,
        )
    }

    #[test]
    fn a_list_overlaps_nothing() {
        let (aggregate, vertices) = aggregate(SplitMethod::None);
        assert_eq!(
            aggregate.overlap_at(PrimitiveId::triangle(0), vertices[0]),
            0.0
        );
    }

    #[test]
    fn nodes_around_a_point_count_unless_the_primitive_is_below_them() {
        let (aggregate, vertices) = aggregate(SplitMethod::Sah);
        // A corner that only its own box contains, and a point of the long triangle in the boxes of
        // others.
        let points = [
            (PrimitiveId::triangle(3), vertices[10]),
            (PrimitiveId::triangle(8), Point::new(3.1, 0.26, 1.0)),
        ];
        let costs = points.map(|(primitive, point)| {
            let place = box_of(aggregate.space.place(&point));
            let is_around = |node: &Node| {
                node.bounds.contains(&place) && !holds(&aggregate.tree, node, primitive)
            };
            let nodes = aggregate.tree.nodes().map(|(node, _)| node);
            let cost = |node: Node| match node.is_leaf() {
                true => f64::from(node.count),
                false => NODE_COST,
            };
            let by_hand: f64 = nodes.filter(is_around).map(cost).sum();
            assert_eq!(aggregate.overlap_at(primitive, point), by_hand);
            by_hand
        });
        assert!(
            costs[1] >= 1.0,
            "the long triangle lies in the box of another leaf"
        );
    }

    fn holds(tree: &BinaryTree<PrimitiveId>, node: &Node, primitive: PrimitiveId) -> bool {
        match node.is_leaf() {
            true => tree.in_leaf(node).contains(&primitive),
            false => (0..2)
                .any(|side| holds(tree, &tree.below[node.first as usize].node(side), primitive)),
        }
    }
}
