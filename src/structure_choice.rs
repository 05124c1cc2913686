//! Chooses the structure for the views of a scene: bins or a tree, and how a tree is built.

use crate::accel::{BuildOptions, Precision, SplitMethod};
use crate::geometry::Point;
use crate::scene::{AcceleratorParameters, Scene};

/// With so many views of one scene, a tree that all share is faster than bins for each:
/// docs/performance.md has the measurements.
const MANY_VIEWS: usize = 16;

/// Whether bins are the fastest structure for a view of a scene with `views` views. Costs
/// `needs_tree`.
pub(crate) fn takes_bins(views: usize, precision: Precision, needs_tree: bool) -> bool {
    // Answers in f32 are those of the eye's own structure.
    !needs_tree && (precision == Precision::Fast || views < MANY_VIEWS)
}

/// Whether a view may be traced through a tree that other views share. Answers in f32, and costs,
/// depend on the anchor, where boxes are the most precise: each view has its own tree, as if it
/// were rendered alone.
pub(crate) fn may_share_tree(precision: Precision, has_costs: bool) -> bool {
    precision == Precision::Exact && !has_costs
}

/// The anchor of a tree for all views of `scene`.
pub(crate) fn shared_anchor(scene: &Scene) -> Point {
    let middle = scene.geometry.extent().centre();
    if middle.is_finite() {
        middle
    } else {
        scene.camera.anchor()
    }
}

/// Build options for `method`, with the leaf size that the scene asks for.
pub(crate) fn build_options(
    method: SplitMethod,
    accelerator: &AcceleratorParameters,
) -> BuildOptions {
    let max_leaf = accelerator
        .max_leaf
        .map_or(BuildOptions::MAX_LEAF, |count| count as usize);
    BuildOptions { method, max_leaf }
}

/// The split method that the scene asks for, or the name that feimos does not know.
pub(crate) fn method_of_scene(accelerator: &AcceleratorParameters) -> Result<SplitMethod, &str> {
    let AcceleratorParameters {
        name, split_method, ..
    } = accelerator;
    match (name.as_deref(), split_method.as_deref()) {
        (None, _) | (Some("bvh"), None) => Ok(SplitMethod::Sah),
        (Some("bvh"), Some(name)) => name.parse().map_err(|_| name),
        (Some(name), _) => Err(name),
    }
}
