//! Trees by depth, for display: nodes, leaves and areas of each level, and the sizes of leaves.

use super::statistics::Statistics;
use crate::accel::Aggregate;
use crate::accel::tree::BinaryTree;
use crate::shape::Geometry;
use std::collections::BTreeMap;

/// What a tree is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TreeKind {
    /// The primitives in no instance.
    Scene,
    /// The instances.
    Instances,
    /// The primitives of an object, by its number.
    Object(usize),
}

/// One binary tree by depth.
#[derive(Debug, Clone, PartialEq)]
pub struct Anatomy {
    /// What the tree is over.
    pub kind: TreeKind,
    /// The levels from the root down, without gaps.
    pub levels: Vec<Level>,
    /// The numbers of leaves by the number of their primitives or instances.
    pub leaf_sizes: BTreeMap<u32, usize>,
    /// The cost of a ray that meets the root, as [`Statistics::sah_cost`] defines it.
    pub sah_cost: f64,
}

/// All nodes of one depth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Level {
    /// Inner nodes and leaves.
    pub nodes: usize,
    /// Nodes that hold primitives or instances.
    pub leaves: usize,
    /// Primitives or instances in these leaves.
    pub items: usize,
    /// The surface of the nodes' boxes divided by that of the root: the number of these nodes that
    /// a random ray through the root meets.
    pub area: f64,
}

impl Aggregate {
    /// All trees that are not empty: that of the scene, that of the instances, and those of the
    /// objects.
    pub fn anatomies(&self, geometry: &Geometry) -> Vec<Anatomy> {
        let statistics = self.statistics_by_tree(geometry);
        let instances = &self.instances;
        let objects = instances
            .objects
            .iter()
            .zip(&statistics.objects)
            .enumerate();
        let objects = objects.filter_map(|(number, (object, statistics))| {
            anatomy(&object.as_ref()?.tree, TreeKind::Object(number), statistics)
        });
        let own = anatomy(&self.tree, TreeKind::Scene, &statistics.own);
        let upper = anatomy(&instances.tree, TreeKind::Instances, &statistics.instances);
        own.into_iter().chain(upper).chain(objects).collect()
    }
}

impl Anatomy {
    /// The sum of a number over all levels.
    pub fn total(&self, of: impl Fn(&Level) -> usize) -> usize {
        self.levels.iter().map(of).sum()
    }
}

/// `None` for a tree over nothing.
fn anatomy<T>(tree: &BinaryTree<T>, kind: TreeKind, statistics: &Statistics) -> Option<Anatomy> {
    let whole = f64::from(tree.root?.bounds.half_area());
    let mut levels = vec![Level::default(); statistics.depth + 1];
    let mut leaf_sizes = BTreeMap::new();
    for (node, depth) in tree.nodes() {
        let level = &mut levels[depth];
        level.nodes += 1;
        level.area += f64::from(node.bounds.half_area()) / whole;
        if node.is_leaf() {
            level.leaves += 1;
            level.items += node.count as usize;
            *leaf_sizes.entry(node.count).or_insert(0) += 1;
        }
    }
    Some(Anatomy {
        kind,
        levels,
        leaf_sizes,
        sah_cost: statistics.sah_cost,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{BuildOptions, SplitMethod};
    use crate::geometry::{Matrix, Point};
    use crate::progress::Progress;

    /// Eight spheres in a row, and two instances of an object of three.
    fn geometry() -> Geometry {
        let mut geometry = Geometry::default();
        let mut object = Geometry::default();
        let add = |geometry: &mut Geometry, x: f64| {
            let place = geometry.add_transform(Matrix::translate([x, 0.0, 5.0]));
            geometry.add_sphere(1.0, None, place, 1).unwrap();
        };
        (0..8).for_each(|x| add(&mut geometry, 3.0 * f64::from(x)));
        (0..3).for_each(|x| add(&mut object, 3.0 * f64::from(x)));
        let object = geometry.add_object(object);
        for y in [10.0, 20.0] {
            let place = Matrix::translate([0.0, y, 0.0]);
            geometry.add_instance(object, place).unwrap();
        }
        geometry
    }

    #[test]
    fn levels_count_every_node_and_every_primitive_once() {
        let geometry = geometry();
        for method in SplitMethod::ALL {
            let options = BuildOptions {
                method,
                max_leaf: 1,
            };
            let aggregate =
                Aggregate::build(&geometry, Point::default(), options, Progress::SILENT);
            let trees = aggregate.anatomies(&geometry);
            let kinds: Vec<TreeKind> = trees.iter().map(|tree| tree.kind).collect();
            let expected = [TreeKind::Scene, TreeKind::Instances, TreeKind::Object(0)];
            assert_eq!(kinds, expected);
            let items: Vec<usize> = trees.iter().map(|tree| tree.total(|l| l.items)).collect();
            assert_eq!(items, [8, 2, 3], "{method}");
            let statistics = aggregate.statistics(&geometry);
            let sum =
                |of: fn(&Level) -> usize| trees.iter().map(|tree| tree.total(of)).sum::<usize>();
            assert_eq!(statistics.nodes, sum(|level| level.nodes));
            assert_eq!(statistics.leaves, sum(|level| level.leaves));
            for tree in &trees {
                let root = tree.levels[0];
                assert_eq!((root.nodes, root.area), (1, 1.0));
                let leaves: usize = tree.leaf_sizes.values().sum();
                assert_eq!(leaves, tree.total(|level| level.leaves));
            }
        }
    }

    #[test]
    fn a_balanced_tree_has_a_power_of_two_nodes_a_level() {
        let method = SplitMethod::Equal;
        let options = BuildOptions {
            method,
            max_leaf: 1,
        };
        let geometry = geometry();
        let aggregate = Aggregate::build(&geometry, Point::default(), options, Progress::SILENT);
        let scene = &aggregate.anatomies(&geometry)[0];
        let nodes: Vec<usize> = scene.levels.iter().map(|level| level.nodes).collect();
        assert_eq!(nodes, [1, 2, 4, 8]);
        assert_eq!(scene.leaf_sizes, BTreeMap::from([(1, 8)]));
        assert_eq!((scene.levels[3].leaves, scene.levels[2].leaves), (8, 0));
    }

    #[test]
    fn nothing_has_no_tree() {
        let (geometry, options) = (Geometry::default(), BuildOptions::new(SplitMethod::Sah));
        let aggregate = Aggregate::build(&geometry, Point::default(), options, Progress::SILENT);
        assert_eq!(aggregate.anatomies(&geometry), []);
        assert_eq!(aggregate.boxes(0..=9), []);
    }
}
