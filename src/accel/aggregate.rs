//! The finished aggregate.

use super::Statistics;
use super::builder::{BuildOptions, Collected, Visibility, collect, space_around};
use super::instance::{InstanceTrees, Outlines};
use super::raster::{BLOCK, Block, WideTree, blocks_of};
use super::space::AnchorSpace;
use super::tree::Tree;
use crate::camera::Camera;
use crate::error::Result;
use crate::film::PixelBounds;
use crate::geometry::Point;
use crate::memory;
use crate::progress::Progress;
use crate::shape::{Geometry, PrimitiveId};

/// Trees over the primitives and the instances of a scene. They refer to them by number; the geometry stays where it is.
#[derive(Debug, PartialEq)]
pub struct Aggregate {
    /// Of the boxes in the world.
    pub(super) space: AnchorSpace,
    /// Over the primitives that are in no instance and can be hit.
    pub(super) tree: Tree<PrimitiveId>,
    /// The same tree for tiles.
    pub(super) wide: WideTree<Block>,
    /// Over all others; of most scenes empty.
    pub(super) instances: InstanceTrees,
    never_hit: usize,
}

impl Aggregate {
    /// Builds over all primitives of `geometry` that can be hit. `anchor` is the point near which boxes are the most
    /// precise: the eye. The tree depends on nothing else, on the number of threads least of all.
    ///
    /// `progress` counts [`Aggregate::work`].
    pub fn build(
        geometry: &Geometry,
        anchor: Point,
        options: BuildOptions,
        progress: Progress,
    ) -> Aggregate {
        let outlines = Outlines::of(geometry);
        let space = space_around(geometry, &outlines.bounds_of_all(geometry), anchor);
        let collected = collect(geometry, &space, None);
        let instances = InstanceTrees::build(geometry, outlines, &space, None, options, progress);
        Aggregate::over(collected, instances, space, geometry, options, progress)
    }

    /// Builds for one picture: over the primitives that a ray of `camera` through a pixel of `window` may meet. Other rays
    /// must not be cast.
    ///
    /// `progress` counts [`Aggregate::work`], what is left out at once.
    pub fn build_for_view(
        geometry: &Geometry,
        camera: &Camera,
        window: &PixelBounds,
        options: BuildOptions,
        progress: Progress,
    ) -> Aggregate {
        let outlines = Outlines::of(geometry);
        let space = space_around(geometry, &outlines.bounds_of_all(geometry), camera.anchor());
        let visibility = Visibility::new(camera, window, geometry, &space);
        let collected = collect(geometry, &space, visibility.as_ref());
        let instances = InstanceTrees::build(
            geometry,
            outlines,
            &space,
            visibility.as_ref(),
            options,
            progress,
        );
        drop(visibility);
        progress.advance(geometry.own_count() - collected.primitives.len());
        Aggregate::over(collected, instances, space, geometry, options, progress)
    }

    /// Whether there is memory for a build: over all of `geometry`, or `for_view`, which may be over none of them.
    ///
    /// # Errors
    /// Where less is left than any such build takes.
    pub fn check_memory(geometry: &Geometry, for_view: bool) -> Result<()> {
        // A primitive has a lane of a block, and a place in the order of leaves; a view looks at vertices first.
        let each = size_of::<Block>() / BLOCK + size_of::<PrimitiveId>();
        let bytes = match for_view {
            false => geometry.own_count() as u64 * each as u64,
            true => size_of_val(geometry.vertices()) as u64 / 2,
        };
        let message = || {
            format!(
                "a tree over {} primitives is too large for this machine's memory",
                geometry.own_count()
            )
        };
        memory::check(bytes, message)
    }

    fn over(
        collected: Collected,
        instances: InstanceTrees,
        space: AnchorSpace,
        geometry: &Geometry,
        options: BuildOptions,
        progress: Progress,
    ) -> Aggregate {
        let Collected {
            primitives,
            never_hit,
        } = collected;
        let tree = Tree::build(primitives, options, progress, PrimitiveId::from_bits);
        let wide = WideTree::of(&tree, |runs| blocks_of(&runs, &tree.order, geometry));
        Aggregate {
            space,
            tree,
            wide,
            instances,
            never_hit,
        }
    }

    /// What a build has to look at: primitives, those of an object once, and instances.
    pub fn work(geometry: &Geometry) -> usize {
        let of_objects: usize = geometry
            .objects()
            .iter()
            .map(|object| object.geometry().own_count())
            .sum();
        geometry.own_count() + geometry.instances().len() + of_objects
    }

    /// Primitives in no instance that no ray can hit: without area, or not finite.
    pub fn never_hit(&self) -> usize {
        self.never_hit
    }

    /// Primitives in the trees, those of instances as often as they are instanced.
    pub fn primitive_count(&self, geometry: &Geometry) -> u64 {
        let in_instance = |instance: &u32| {
            self.instances
                .object(geometry, *instance as usize)
                .tree
                .order
                .len() as u64
        };
        self.tree.order.len() as u64
            + self
                .instances
                .tree
                .order
                .iter()
                .map(in_instance)
                .sum::<u64>()
    }

    /// Counts and costs of the trees.
    pub fn statistics(&self, geometry: &Geometry) -> Statistics {
        Statistics::of(self, geometry)
    }
}
