//! The tree of `--stats`, and the tests of an image's rays in it.

use super::built::BuiltTree;
use crate::accel::{Precision, SplitMethod, Statistics, TraversalCounts};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::progress::Progress;
use crate::render::count_tests;
use crate::shape::Geometry;

/// A tree, and the tests of an image's rays in it.
pub(super) struct TreeStatistics {
    pub(super) method: SplitMethod,
    pub(super) size: Statistics,
    /// Whether the image was traced through this tree. If not, it was traced through bins, and the
    /// tree was built for the statistics alone.
    pub(super) is_traced: bool,
    /// Summed over all rays, each traced by itself.
    pub(super) counts: TraversalCounts,
}

impl TreeStatistics {
    /// Traces the rays of `window` one by one through `tree`. `progress` counts rays.
    pub(super) fn count(
        tree: &BuiltTree,
        geometry: &Geometry,
        camera: &Camera,
        window: PixelBounds,
        precision: Precision,
        progress: Progress,
    ) -> TreeStatistics {
        let aggregate = tree.aggregate();
        TreeStatistics {
            method: tree.method(),
            size: tree.statistics(),
            is_traced: true,
            counts: count_tests(camera, geometry, aggregate, window, precision, progress),
        }
    }
}
