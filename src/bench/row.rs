//! One line of results.

use super::Spread;
use crate::accel::{Precision, SplitMethod};
use serde::Serialize;

/// What was measured of one accelerator at one precision on one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The scene as the user named it.
    pub scene: String,
    /// How primitives were aggregated.
    pub method: SplitMethod,
    /// How hits were decided.
    pub precision: Precision,
    /// Threads that built and traced.
    pub threads: usize,
    /// Rays of one run: one for each pixel.
    pub rays: u64,
    /// Geometry to tree, milliseconds.
    pub build_ms: Spread,
    /// Rays to all channels of the image, milliseconds.
    pub trace_ms: Spread,
    /// Boxes of nodes that were tested, all rays together.
    pub nodes: u64,
    /// Primitives that were tested, all rays together.
    pub primitives: u64,
    /// The tree's cost by the surface area heuristic.
    pub sah_cost: f64,
    /// Steps from the root to the deepest leaf.
    pub depth: usize,
    /// Bytes of the tree.
    pub bytes: usize,
    /// How wrong the answers were, where that was measured.
    pub errors: Option<Errors>,
    /// Rays that needed integers; `None` where the precision is not exact, which has no such thing.
    pub fallback_rays: Option<u64>,
}

/// How far answers are from the exact ones.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Errors {
    /// Pixels whose exact answer was worked out.
    pub sampled_pixels: u64,
    /// Of those, hits for misses and misses for hits.
    pub wrong_hits: u64,
    /// Of those that are hits in both, other primitives.
    pub wrong_primitives: u64,
    /// The largest error of a depth, in units in the last place of the exact one.
    pub max_ulp: f64,
    /// What 99 of 100 depths stay within.
    pub p99_ulp: f64,
    /// The mean of those errors.
    pub mean_ulp: f64,
}

impl Row {
    /// Millions of rays a second, in the middle run.
    pub fn mrays_per_s(&self) -> f64 {
        self.rays as f64 / self.trace_ms.median / 1e3
    }

    /// Boxes of nodes that a ray is tested against, on average.
    pub fn nodes_per_ray(&self) -> f64 {
        self.nodes as f64 / self.rays as f64
    }

    /// Primitives that a ray is tested against, on average.
    pub fn primitives_per_ray(&self) -> f64 {
        self.primitives as f64 / self.rays as f64
    }
}
