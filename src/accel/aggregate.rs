//! The finished aggregate.

use super::Statistics;
use super::build::{BuildOptions, Collected, Visibility, build_tree, collect, space_around};
use super::node::{Children, Node, Subtree};
use super::space::AnchorSpace;
use super::tile::WideTree;
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::geometry::Point;
use crate::progress::Progress;
use crate::shape::{Primitive, Shapes};

/// A tree over the primitives of a scene. It refers to them by number; the geometry stays where it is.
#[derive(Debug, PartialEq)]
pub struct Aggregate {
    pub(super) space: AnchorSpace,
    /// `None` where no primitive can be hit.
    pub(super) root: Option<Node>,
    pub(super) below: Vec<Children>,
    /// The primitives in the order of the leaves.
    pub(super) order: Vec<Primitive>,
    /// The same tree for tiles.
    pub(super) wide: WideTree,
    never_hit: usize,
}

impl Aggregate {
    /// Builds over all primitives of `shapes` that can be hit. `anchor` is the point near which boxes are the most
    /// precise: the eye. The tree depends on nothing else, on the number of threads least of all.
    ///
    /// `progress` counts primitives.
    pub fn build(shapes: &Shapes, anchor: Point, options: BuildOptions, progress: Progress) -> Aggregate {
        let space = space_around(shapes, anchor);
        Aggregate::over(collect(shapes, &space, None), space, shapes, options, progress)
    }

    /// Builds for one picture: over the primitives that a ray of `camera` through a pixel of `window` may meet. Other rays
    /// must not be cast.
    ///
    /// `progress` counts primitives, those left out at once.
    pub fn build_for_view(
        shapes: &Shapes,
        camera: &Camera,
        window: &PixelBounds,
        options: BuildOptions,
        progress: Progress,
    ) -> Aggregate {
        let space = space_around(shapes, camera.anchor());
        let visibility = Visibility::new(camera, window, shapes, &space);
        let collected = collect(shapes, &space, visibility.as_ref());
        drop(visibility);
        progress.advance(shapes.primitive_count() - collected.primitives.len());
        Aggregate::over(collected, space, shapes, options, progress)
    }

    fn over(
        collected: Collected,
        space: AnchorSpace,
        shapes: &Shapes,
        options: BuildOptions,
        progress: Progress,
    ) -> Aggregate {
        let Collected { primitives, never_hit } = collected;
        if primitives.is_empty() {
            let wide = WideTree::of(None, &[], &[], shapes);
            return Aggregate { space, root: None, below: Vec::new(), order: Vec::new(), wide, never_hit };
        }
        let (Subtree { root, below }, order) = build_tree(primitives, options, progress);
        let wide = WideTree::of(Some(&root), &below, &order, shapes);
        Aggregate { space, root: Some(root), below, order, wide, never_hit }
    }

    /// Primitives that no ray can hit: without area, or not finite.
    pub fn never_hit(&self) -> usize {
        self.never_hit
    }

    /// Primitives in the tree.
    pub fn primitive_count(&self) -> usize {
        self.order.len()
    }

    /// Counts and costs of the tree.
    pub fn statistics(&self) -> Statistics {
        Statistics::of(self)
    }
}
