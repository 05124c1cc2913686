//! The finished aggregate.

use super::anchor_space::AnchorSpace;
use super::build_primitive::{self, BuildPrimitive, Collected, bounds_of};
use super::full_leaves::LeafSize;
use super::hlbvh;
use super::node::{Children, Node, Subtree};
use super::splitter::Splitter;
use super::tile::WideTree;
use super::top_down::TopDown;
use super::visibility::Visibility;
use super::{SplitMethod, Statistics};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::geometry::Point;
use crate::progress::Progress;
use crate::shape::{Primitive, Shapes};
use rayon::prelude::*;

/// How to build.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BuildOptions {
    /// How lists of primitives are split.
    pub method: SplitMethod,
    /// Primitives in a leaf at most (pbrt's `maxnodeprims`), 1 or more; without meaning for [`SplitMethod::None`].
    pub max_leaf: usize,
}

impl BuildOptions {
    /// As many as a test of a tile against a leaf takes at a time. pbrt's default is 4.
    pub const MAX_LEAF: usize = 16;

    /// `method` with leaves of the usual size.
    pub fn new(method: SplitMethod) -> BuildOptions {
        BuildOptions { method, max_leaf: Self::MAX_LEAF }
    }
}

/// No tree is deeper, so no traversal needs a longer stack: 64 levels of free choice, then halving.
pub(super) const MAX_DEPTH: usize = 96;

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
        let space = build_primitive::space_around(shapes, anchor);
        Aggregate::over(build_primitive::collect(shapes, &space, None), space, shapes, options, progress)
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
        let space = build_primitive::space_around(shapes, camera.anchor());
        let visibility = Visibility::new(camera, window, shapes, &space);
        let collected = build_primitive::collect(shapes, &space, visibility.as_ref());
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

/// The tree and the primitives in the order of its leaves.
fn build_tree(
    mut primitives: Vec<BuildPrimitive>,
    options: BuildOptions,
    progress: Progress,
) -> (Subtree, Vec<Primitive>) {
    let leaf_size = LeafSize(options.max_leaf.clamp(1, Primitive::MAX_COUNT));
    let subtree = match options.method {
        SplitMethod::None => {
            progress.advance(primitives.len());
            Subtree { root: Node::leaf(bounds_of(&primitives), 0, primitives.len() as u32), below: Vec::new() }
        }
        SplitMethod::Hlbvh => return hlbvh::build(&primitives, leaf_size, MAX_DEPTH as u32, progress),
        method => {
            let splitter = Splitter { method, leaf_size };
            TopDown { splitter, max_depth: MAX_DEPTH as u32, progress }.build(&mut primitives, 0)
        }
    };
    (subtree, primitives.par_iter().map(BuildPrimitive::primitive).collect())
}
