//! The plan of a measurement.

use crate::accel::{BuildOptions, SplitMethod, TILE};
use crate::bench::kernel::Kernel;
use crate::bench::trace::{Random, TileSample};
use crate::scene::Scene;

/// The builds and kernels to run on a scene, and how often.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The accelerators.
    pub builds: Vec<BuildOptions>,
    /// The kernels that trace each tree.
    pub kernels: Vec<Kernel>,
    /// The number of rounds.
    pub rounds: Rounds,
    /// Make pictures, too.
    pub with_pictures: bool,
}

/// The number of rounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rounds {
    /// Rounds before the measurement.
    pub warmup: usize,
    /// Measured rounds, 1 or more.
    pub runs: usize,
}

impl Plan {
    /// The number of builds and traces, including those that are not timed.
    pub fn steps(&self) -> usize {
        let round = self.builds.len().saturating_mul(1 + self.kernels.len());
        round.saturating_mul(1 + self.rounds.warmup + self.rounds.runs)
    }
}

/// Primitive tests in a run; if a list of all primitives needs more, it is tried on some tiles
/// only.
const MAX_TESTS: u64 = 1 << 30;

/// Primitive tests that these tiles need if each tests every primitive once.
const SAMPLE_TESTS: u64 = 1 << 24;

/// No more than one of this many tiles is chosen.
const TILES_FOR_ONE: u64 = 8;

/// The tiles that `method` is tried on; `None` for all.
pub(super) fn sample_of(
    method: SplitMethod,
    scene: &Scene,
    random: &mut Random,
) -> Option<TileSample> {
    let (rays, primitives) = (scene.film.crop.area(), scene.geometry.primitive_count());
    if method != SplitMethod::None || rays.saturating_mul(primitives) <= MAX_TESTS {
        return None;
    }
    let tiles = rays / u64::from(TILE * TILE);
    let count = (SAMPLE_TESTS / primitives)
        .min(tiles / TILES_FOR_ONE)
        .max(4);
    (count < tiles).then(|| TileSample::new(count, &scene.film.crop, random))
}
