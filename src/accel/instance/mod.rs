//! Instances of objects: a tree over their boxes, and for each object a tree in the space of its
//! instances.
//!
//! Traversal transforms the boxes of an object to the world, where they still enclose their
//! contents. Primitives are tested exactly where they are: each is transformed to the world by
//! itself (rule R4).

mod object_blocks;
mod object_tree;
mod outline;
mod placement;

pub(super) use self::object_blocks::ObjectBlocks;
pub(super) use self::object_tree::ObjectTree;
pub(super) use self::placement::Placement;

use self::outline::Outline;
use super::builder::{self, BuildOptions, BuildPrimitive};
use super::space::AnchorSpace;
use super::tree::{BinaryTree, Run, WideTree, collapse};
use crate::geometry::Bounds;
use crate::progress::Progress;
use crate::shape::Geometry;
use rayon::prelude::*;

/// The largest number of instances in a leaf: each costs as much as a tree.
const MAX_LEAF: usize = 4;

/// The outlines of all objects of a scene.
#[derive(Debug)]
pub(super) struct Outlines(Vec<Outline>);

impl Outlines {
    pub(super) fn of(geometry: &Geometry) -> Outlines {
        Outlines(geometry.objects().iter().map(Outline::of).collect())
    }

    fn placement(&self, geometry: &Geometry, instance: usize) -> Placement {
        let instance = &geometry.instances()[instance];
        Placement::new(
            instance.world_from_instance(),
            &self.0[instance.object()].terms,
        )
    }

    /// The box around an instance in the world; `None` if nothing of it can be hit.
    fn bounds(&self, geometry: &Geometry, instance: usize) -> Option<Bounds> {
        let outline = &self.0[geometry.instances()[instance].object()];
        let is_there = !outline.is_empty()
            && geometry.instances()[instance]
                .world_from_instance()
                .is_finite();
        is_there.then(|| self.placement(geometry, instance).enclose(&outline.bounds))
    }

    /// The box around all instances.
    pub(super) fn bounds_of_all(&self, geometry: &Geometry) -> Bounds {
        let bounds = |instance| self.bounds(geometry, instance).unwrap_or(Bounds::EMPTY);
        let instances = (0..geometry.instances().len()).into_par_iter();
        instances
            .map(bounds)
            .reduce(|| Bounds::EMPTY, Bounds::union)
    }
}

/// The tree over a scene's instances, and the trees of its objects.
#[derive(Debug, PartialEq)]
pub(super) struct InstanceTrees {
    /// The tree over the instances, in the space of the world's tree.
    pub(super) tree: BinaryTree<u32>,
    /// The same tree for tiles.
    pub(super) wide: WideTree<Run>,
    /// The tree of each object; `None` for objects without a visible instance.
    pub(super) objects: Vec<Option<ObjectTree>>,
}

impl InstanceTrees {
    /// Builds the trees over the instances of whose boxes `is_seen` is true.
    ///
    /// `progress` counts instances and primitives of objects; those left out count at once.
    pub(super) fn build(
        geometry: &Geometry,
        outlines: Outlines,
        space: &AnchorSpace,
        is_seen: &(dyn Fn(&Bounds) -> bool + Sync),
        options: BuildOptions,
        progress: Progress,
    ) -> InstanceTrees {
        let count = geometry.instances().len();
        let place = |instance: usize| {
            let bounds = outlines.bounds(geometry, instance)?;
            is_seen(&bounds).then(|| BuildPrimitive::new(&space.enclose(&bounds), instance as u32))
        };
        let seen: Vec<BuildPrimitive> = (0..count).into_par_iter().filter_map(place).collect();
        progress.advance(count - seen.len());
        let leaf = BuildOptions {
            max_leaf: options.max_leaf.min(MAX_LEAF),
            ..options
        };
        let tree = builder::build(seen, leaf, progress, |instance| instance);
        let mut is_visible = vec![false; geometry.objects().len()];
        tree.order.iter().for_each(|instance| {
            is_visible[geometry.instances()[*instance as usize].object()] = true
        });
        let objects = geometry
            .objects()
            .iter()
            .zip(outlines.0)
            .zip(is_visible)
            .map(|((object, outline), is_visible)| {
                if !is_visible {
                    progress.advance(object.own_count());
                }
                is_visible.then(|| ObjectTree::build(object, outline, options, progress))
            });
        let objects = objects.collect();
        InstanceTrees {
            wide: collapse(&tree),
            tree,
            objects,
        }
    }

    /// The object's tree of an instance that is in the tree.
    pub(super) fn object(&self, geometry: &Geometry, instance: usize) -> &ObjectTree {
        let object = &self.objects[geometry.instances()[instance].object()];
        object.as_ref().expect("a visible object has a tree")
    }

    /// The memory of the trees in bytes.
    pub(super) fn bytes(&self) -> usize {
        let objects = self.objects.iter().flatten().map(ObjectTree::bytes);
        self.tree.bytes() + self.wide.bytes() + objects.sum::<usize>()
    }
}
