//! A row for tests.

use super::{Row, Spread, TraceParts};
use crate::accel::{Accelerator, SplitMethod};
use crate::bench::error::Errors;
use crate::bench::kernel::Kernel;
use crate::compare::{Tally, Ulps};
use crate::simd::Level;

/// The row of a tree.
pub(crate) fn row(method: SplitMethod, kernel: Kernel, compared: u64) -> Row {
    row_of(Accelerator::Tree(method), kernel, compared)
}

/// A row of an image of 1000 pixels, of which `compared` were compared: with a false hit, two wrong
/// primitives, and a depth error of 3.
pub(crate) fn row_of(accelerator: Accelerator, kernel: Kernel, compared: u64) -> Row {
    let has_tree = accelerator != Accelerator::Raster;
    let spread = |[min, median, max]: [f64; 3]| Spread { min, median, max };
    let mut depths = Ulps::default();
    [0, 0, 0, 3].iter().for_each(|error| depths.add(*error));
    let tally = Tally {
        pixels: compared,
        false_hits: 1,
        missed_hits: 0,
        wrong_primitives: 2,
        depths,
        ..Tally::default()
    };
    Row {
        scene: "a.pbrt".into(),
        accelerator,
        kernel,
        threads: 2,
        simd: Level::Portable,
        rays: 1000,
        pixels: 1000,
        load_ms: spread([1.0, 2.0, 3.0]),
        build_ms: spread([415.2, 461.1, 491.9]),
        trace_ms: spread([49.96, 50.0, 53.04]),
        trace_parts: (!kernel.needs_tree()).then_some(TraceParts {
            prepare: spread([1.0, 2.0, 3.0]),
            divide: spread([0.1, 0.2, 0.3]),
            tiles: spread([40.0, 45.0, 50.0]),
            join: spread([0.01, 0.02, 0.03]),
            idle: spread([0.0, 1.0, 2.0]),
        }),
        nodes_per_ray: has_tree.then_some(19.89),
        primitives_per_ray: has_tree.then_some(1234.567),
        sah_cost: has_tree.then_some(49.13),
        overlap: has_tree.then_some(3.25),
        depth: has_tree.then_some(26),
        bytes: 34_218_112,
        input: None,
        errors: (compared > 0).then_some(Errors { tally, of: 1000 }),
        fallback_rays: kernel.is_exact().then_some(12_345),
    }
}
