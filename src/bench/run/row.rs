//! One row of results.

use super::spread::Spread;
use super::trace_parts::TraceParts;
use crate::accel::Accelerator;
use crate::bench::error::{Errors, InputError};
use crate::bench::kernel::Kernel;
use crate::simd::Level;

/// The measurements of one accelerator with one kernel on one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The scene as the user named it.
    pub scene: String,
    /// How rays found primitives.
    pub accelerator: Accelerator,
    /// How hits were decided.
    pub kernel: Kernel,
    /// Threads that built and traced.
    pub threads: usize,
    /// The instruction set of the kernels.
    pub simd: Level,
    /// Rays of one run.
    pub rays: u64,
    /// Pixels of the image: more than rays if only some tiles are traced.
    pub pixels: u64,
    /// From the scene file to geometry, in milliseconds.
    pub load_ms: Spread,
    /// From geometry to the tree or the bins, in milliseconds.
    pub build_ms: Spread,
    /// From rays to all channels of the image, in milliseconds.
    pub trace_ms: Spread,
    /// The parts of `trace_ms`; `None` if rays are traced one by one, or are a sample.
    pub trace_parts: Option<TraceParts>,
    /// Mean number of node boxes that a ray tests if it is traced alone through the whole tree.
    /// Here and below, `None` without a tree.
    pub nodes_per_ray: Option<f64>,
    /// Mean number of primitives that such a ray tests.
    pub primitives_per_ray: Option<f64>,
    /// The tree's cost by the surface area heuristic.
    pub sah_cost: Option<f64>,
    /// The overlap of its nodes with surfaces of other nodes (EPO), where it is cheap to estimate:
    /// for scenes of triangles without instances.
    pub overlap: Option<f64>,
    /// Steps from the root to the deepest leaf.
    pub depth: Option<usize>,
    /// Bytes of the tree or the bins.
    pub bytes: usize,
    /// How far rounding of the input moves hits; the same for all rows of a scene.
    pub input: Option<InputError>,
    /// The errors of the answers, if they were measured.
    pub errors: Option<Errors>,
    /// Rays that needed exact fallbacks; `None` for kernels without them.
    pub fallback_rays: Option<u64>,
}

impl Row {
    /// Millions of rays a second, in the median run.
    pub fn mrays_per_s(&self) -> f64 {
        self.rays as f64 / self.trace_ms.median / 1e3
    }

    /// Cycles of all threads together for a ray, in the median run, at a clock of `mhz`.
    pub fn cycles_per_ray(&self, mhz: f64) -> f64 {
        self.trace_ms.median * 1e3 * mhz * self.threads as f64 / self.rays as f64
    }

    /// The errors, if they were measured.
    pub fn errors(&self) -> Option<&Errors> {
        self.errors.as_ref()
    }

    /// Returns true if only some tiles of the image are traced.
    pub fn is_sampled(&self) -> bool {
        self.rays < self.pixels
    }
}
