//! One line of results.

use super::{Errors, InputError, Kernel, Spread};
use crate::accel::SplitMethod;

/// What was measured of one accelerator with one kernel on one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The scene as the user named it.
    pub scene: String,
    /// How primitives were aggregated.
    pub method: SplitMethod,
    /// How hits were decided.
    pub kernel: Kernel,
    /// Threads that built and traced.
    pub threads: usize,
    /// Rays of one run.
    pub rays: u64,
    /// Pixels of the picture: more than rays, where only some tiles are traced.
    pub pixels: u64,
    /// Scene file to geometry, milliseconds.
    pub load_ms: Spread,
    /// Geometry to tree, milliseconds.
    pub build_ms: Spread,
    /// Rays to all channels of the image, milliseconds.
    pub trace_ms: Spread,
    /// Boxes of nodes that a ray is tested against on average, alone and in the whole tree.
    pub nodes_per_ray: f64,
    /// Primitives that a ray is tested against, likewise.
    pub primitives_per_ray: f64,
    /// The tree's cost by the surface area heuristic.
    pub sah_cost: f64,
    /// How much its nodes overlap surfaces that are not theirs (EPO), where that is cheap to estimate: of triangles in no instance.
    pub overlap: Option<f64>,
    /// Steps from the root to the deepest leaf.
    pub depth: usize,
    /// Bytes of the tree.
    pub bytes: usize,
    /// How far the rounding of transforms moves what is seen; of the scene, whatever the row.
    pub input: Option<InputError>,
    /// How wrong the answers were, where that was measured.
    pub errors: Option<Errors>,
    /// Rays that needed integers; `None` where the kernel has no such thing.
    pub fallback_rays: Option<u64>,
}

impl Row {
    /// Millions of rays a second, in the middle run.
    pub fn mrays_per_s(&self) -> f64 {
        self.rays as f64 / self.trace_ms.median / 1e3
    }

    /// Cycles of all threads together for a ray, in the middle run, at a clock of `mhz`.
    pub fn cycles_per_ray(&self, mhz: f64) -> f64 {
        self.trace_ms.median * 1e3 * mhz * self.threads as f64 / self.rays as f64
    }

    /// Whether only some tiles of the picture are traced.
    pub fn is_sampled(&self) -> bool {
        self.rays < self.pixels
    }
}
