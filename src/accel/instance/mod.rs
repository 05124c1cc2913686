//! Instances of objects: a tree over their boxes, and for each object a tree in the space of its instances.
//!
//! A box of an object is taken to the world when a ray or a tile comes by. It is never smaller there than what is in it, but
//! triangles and spheres are tested where they are exactly: moved to the world one by one (rule R4).

mod object_tree;
mod outline;
mod placement;

pub(super) use self::object_tree::ObjectTree;
pub(super) use self::placement::Placement;

use self::outline::Outline;
use super::builder::{self, BuildOptions, BuildPrimitive, Visibility};
use super::space::AnchorSpace;
use super::tree::{BinaryTree, Run, WideTree, collapse};
use crate::geometry::Bounds;
use crate::progress::Progress;
use crate::shape::Geometry;
use rayon::prelude::*;

/// Instances in a leaf at most: each is as much work as a tree.
const MAX_LEAF: usize = 4;

/// The outlines of all objects of a scene.
#[derive(Debug)]
pub(super) struct Outlines(Vec<Outline>);

impl Outlines {
    pub(super) fn of(geometry: &Geometry) -> Outlines {
        Outlines(
            geometry
                .objects()
                .iter()
                .map(|object| Outline::of(object.geometry()))
                .collect(),
        )
    }

    fn placement(&self, geometry: &Geometry, instance: usize) -> Placement {
        let instance = &geometry.instances()[instance];
        Placement::new(
            instance.world_from_instance(),
            &self.0[instance.object()].terms,
        )
    }

    /// The box around an instance in the world; `None` where nothing of it can be hit.
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
        (0..geometry.instances().len())
            .into_par_iter()
            .map(bounds)
            .reduce(|| Bounds::EMPTY, Bounds::union)
    }
}

/// The trees of a scene's instances.
#[derive(Debug, PartialEq)]
pub(super) struct InstanceTrees {
    /// Over the instances, in the space of the world's tree.
    pub(super) tree: BinaryTree<u32>,
    /// The same tree for tiles.
    pub(super) wide: WideTree<Run>,
    /// Of each object; of those that no instance shows `None`.
    pub(super) objects: Vec<Option<ObjectTree>>,
}

impl InstanceTrees {
    /// Over the instances that `visibility` sees, where that is given.
    ///
    /// `progress` counts instances, and primitives of objects, those left out at once.
    pub(super) fn build(
        geometry: &Geometry,
        outlines: Outlines,
        space: &AnchorSpace,
        visibility: Option<&Visibility>,
        options: BuildOptions,
        progress: Progress,
    ) -> InstanceTrees {
        let count = geometry.instances().len();
        let place = |instance: usize| {
            let bounds = outlines.bounds(geometry, instance)?;
            let is_seen = visibility.is_none_or(|visibility| visibility.may_see_box(&bounds));
            is_seen.then(|| BuildPrimitive::new(&space.enclose(&bounds), instance as u32))
        };
        let seen: Vec<BuildPrimitive> = (0..count).into_par_iter().filter_map(place).collect();
        progress.advance(count - seen.len());
        let leaf = BuildOptions {
            max_leaf: options.max_leaf.min(MAX_LEAF),
            ..options
        };
        let tree = builder::build(seen, leaf, progress, |instance| instance);
        let mut is_shown = vec![false; geometry.objects().len()];
        tree.order.iter().for_each(|instance| {
            is_shown[geometry.instances()[*instance as usize].object()] = true
        });
        let objects = geometry.objects().iter().zip(outlines.0).zip(is_shown).map(
            |((object, outline), is_shown)| {
                if !is_shown {
                    progress.advance(object.geometry().own_count());
                }
                is_shown.then(|| ObjectTree::build(object.geometry(), outline, options, progress))
            },
        );
        let objects = objects.collect();
        InstanceTrees {
            wide: collapse(&tree),
            tree,
            objects,
        }
    }

    /// The tree of the object of an instance that is in the tree.
    pub(super) fn object(&self, geometry: &Geometry, instance: usize) -> &ObjectTree {
        let object = &self.objects[geometry.instances()[instance].object()];
        object.as_ref().expect("an object that is shown has a tree")
    }

    /// Bytes that the trees take.
    pub(super) fn bytes(&self) -> usize {
        let objects = self.objects.iter().flatten().map(ObjectTree::bytes);
        self.tree.bytes() + self.wide.bytes() + objects.sum::<usize>()
    }
}
