//! The finished aggregate: trees over the primitives and instances of a scene.

use super::builder::{self, BuildOptions, Collected, collect, space_around};
use super::instance::{InstanceTrees, Outlines};
use super::space::AnchorSpace;
use super::tree::{BLOCK_SIZE, BinaryTree, PrimitiveBlock, WideTree, collapse, primitive_blocks};
use crate::error::{Result, counted};
use crate::geometry::Point;
use crate::memory;
use crate::progress::Progress;
use crate::shape::{Geometry, PrimitiveId};

/// Trees over the primitives and the instances of a scene. They refer to them by number; the
/// geometry stays where it is.
#[derive(Debug, PartialEq)]
pub struct Aggregate {
    /// The space of the boxes in the world.
    pub(super) space: AnchorSpace,
    /// The tree over the primitives in no instance that can be hit.
    pub(super) tree: BinaryTree<PrimitiveId>,
    /// The same tree for tiles.
    pub(super) wide: WideTree<PrimitiveBlock>,
    /// The trees over the instances; empty for most scenes.
    pub(super) instances: InstanceTrees,
    never_hit: usize,
}

impl Aggregate {
    /// Builds trees over all primitives of `geometry` that can be hit.
    ///
    /// `anchor`, normally the eye, is the point near which boxes are most precise. The trees do not
    /// depend on the number of threads. `progress` counts [`Aggregate::item_count`] items.
    pub fn build(
        geometry: &Geometry,
        anchor: Point,
        options: BuildOptions,
        progress: Progress,
    ) -> Aggregate {
        progress.check();
        let outlines = Outlines::of(geometry);
        let space = space_around(geometry, &outlines.bounds_of_all(geometry), anchor);
        let Collected {
            primitives,
            never_hit,
        } = collect(geometry, &space);
        let instances =
            InstanceTrees::build(geometry, outlines, &space, &|_| true, options, progress);
        progress.check();
        let tree = builder::build(primitives, options, progress, PrimitiveId::from_bits);
        progress.check();
        let WideTree {
            nodes,
            blocks: runs,
        } = collapse(&tree);
        let blocks = primitive_blocks(&runs, &tree.order, geometry);
        Aggregate {
            space,
            tree,
            wide: WideTree { nodes, blocks },
            instances,
            never_hit,
        }
    }

    /// Checks that there is memory for a build.
    ///
    /// # Errors
    /// If less memory is free than the smallest such build takes.
    pub fn check_memory(geometry: &Geometry) -> Result<()> {
        // A primitive has a lane of a block and an entry in the order of leaves.
        let each = size_of::<PrimitiveBlock>() / BLOCK_SIZE + size_of::<PrimitiveId>();
        let bytes = geometry.own_count() as u64 * each as u64;
        let message = || {
            let primitives = counted(geometry.own_count() as u64, "primitive");
            format!("a tree over {primitives} is too large for this machine's memory")
        };
        memory::check(bytes, message)
    }

    /// The number of items that a build processes: primitives, with those of each object once, and
    /// instances.
    pub fn item_count(geometry: &Geometry) -> usize {
        let objects = geometry.objects().iter();
        let in_objects: usize = objects.map(|object| object.own_count()).sum();
        geometry.own_count() + geometry.instances().len() + in_objects
    }

    /// The number of primitives in no instance that no ray can hit: without area, or not finite.
    pub fn never_hit(&self) -> usize {
        self.never_hit
    }

    /// The number of primitives in the trees. Those of an object count once for each instance.
    pub fn primitive_count(&self, geometry: &Geometry) -> u64 {
        let in_instance = |instance: &u32| {
            let object = self.instances.object(geometry, *instance as usize);
            object.tree.order.len() as u64
        };
        let in_instances: u64 = self.instances.tree.order.iter().map(in_instance).sum();
        self.tree.order.len() as u64 + in_instances
    }
}
