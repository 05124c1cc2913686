//! The report on the trees of a scene: one struct for `--json`, whose keys are its field names, and
//! for text.

mod text;

use crate::accel::{Aggregate, Anatomy, Level, SplitMethod, Statistics, TreeKind};
use crate::scene::Scene;
use serde::Serialize;
use std::path::Path;

#[derive(Debug, Serialize)]
pub(super) struct Report {
    scene: String,
    accel: &'static str,
    /// Nodes of all trees; those of an object count once.
    nodes: usize,
    leaves: usize,
    /// Steps from the root to the deepest leaf, through the trees of objects.
    depth: usize,
    sah_cost: f64,
    /// Memory of all trees.
    bytes: usize,
    /// Primitives in no instance that no ray can hit: they are in no tree.
    never_hit: usize,
    trees: Vec<Tree>,
}

/// A binary tree.
#[derive(Debug, Serialize)]
struct Tree {
    /// What the tree is over.
    over: &'static str,
    /// The number of the object, counted from 1.
    object: Option<usize>,
    /// The instances that show the object.
    instances: Option<usize>,
    /// Primitives in the leaves, or instances.
    items: usize,
    nodes: usize,
    leaves: usize,
    depth: usize,
    sah_cost: f64,
    levels: Vec<TreeLevel>,
    leaf_sizes: Vec<LeafSize>,
}

/// All nodes of one depth.
#[derive(Debug, Serialize)]
struct TreeLevel {
    depth: usize,
    nodes: usize,
    leaves: usize,
    items: usize,
    /// The surface of the boxes divided by that of the root's.
    area: f64,
}

#[derive(Debug, Serialize)]
struct LeafSize {
    items: u32,
    leaves: usize,
}

impl Report {
    pub(super) fn new(
        path: &Path,
        scene: &Scene,
        method: SplitMethod,
        aggregate: &Aggregate,
    ) -> Report {
        let Statistics {
            nodes,
            leaves,
            depth,
            sah_cost,
            bytes,
        } = aggregate.statistics(&scene.geometry);
        let trees = aggregate.anatomies(&scene.geometry);
        let mut instances = vec![0; scene.geometry.objects().len()];
        for instance in scene.geometry.instances() {
            instances[instance.object()] += 1;
        }
        Report {
            scene: path.display().to_string(),
            accel: method.name(),
            nodes,
            leaves,
            depth,
            sah_cost,
            bytes,
            never_hit: aggregate.never_hit(),
            trees: trees
                .iter()
                .map(|tree| Tree::new(tree, &instances))
                .collect(),
        }
    }
}

impl Tree {
    /// `instances` counts those of each object.
    fn new(anatomy: &Anatomy, instances: &[usize]) -> Tree {
        let (over, object) = match anatomy.kind {
            TreeKind::Scene => ("scene", None),
            TreeKind::Instances => ("instances", None),
            TreeKind::Object(number) => ("object", Some(number)),
        };
        let leaf_sizes = anatomy.leaf_sizes.iter();
        Tree {
            over,
            object: object.map(|number| number + 1),
            instances: object.map(|number| instances[number]),
            items: anatomy.total(|level| level.items),
            nodes: anatomy.total(|level| level.nodes),
            leaves: anatomy.total(|level| level.leaves),
            depth: anatomy.levels.len() - 1,
            sah_cost: anatomy.sah_cost,
            levels: anatomy
                .levels
                .iter()
                .enumerate()
                .map(TreeLevel::new)
                .collect(),
            leaf_sizes: leaf_sizes
                .map(|(items, leaves)| LeafSize {
                    items: *items,
                    leaves: *leaves,
                })
                .collect(),
        }
    }
}

impl TreeLevel {
    fn new((depth, level): (usize, &Level)) -> TreeLevel {
        TreeLevel {
            depth,
            nodes: level.nodes,
            leaves: level.leaves,
            items: level.items,
            area: level.area,
        }
    }
}
