//! The plan of a measurement.

use crate::accel::{Accelerator, BuildOptions, SplitMethod, TILE};
use crate::bench::kernel::Kernel;
use crate::bench::trace::{Random, TileSample};
use crate::scene::Scene;
use crate::simd::Level;

/// The builds and kernels to run on a scene, and how often.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The accelerators.
    pub builds: Vec<Build>,
    /// The kernels to trace with, each by the accelerators that it suits.
    pub kernels: Vec<Kernel>,
    /// The instruction set of the kernels.
    pub level: Level,
    /// The number of rounds.
    pub rounds: Rounds,
    /// Make pictures, too.
    pub with_pictures: bool,
}

/// An accelerator to build.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Build {
    /// The accelerator.
    pub accelerator: Accelerator,
    /// How its trees are built; for bins, those over instances.
    pub trees: BuildOptions,
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
        let steps = self.builds.iter().map(|build| self.steps_of(*build));
        steps.fold(0, usize::saturating_add)
    }

    /// The number of builds and traces of one accelerator.
    pub(super) fn steps_of(&self, build: Build) -> usize {
        let kernels = self.kernels.iter();
        let kernels = kernels.filter(|kernel| kernel.suits(build.accelerator));
        (1 + kernels.count()).saturating_mul(1 + self.rounds.warmup + self.rounds.runs)
    }
}

/// Primitive tests in a run; if a list of all primitives needs more, it is tried on some tiles
/// only.
const MAX_TESTS: u64 = 1 << 30;

/// Primitive tests that these tiles need if each tests every primitive once.
const SAMPLE_TESTS: u64 = 1 << 24;

/// No more than one of this many tiles is chosen.
const TILES_FOR_ONE: u64 = 8;

/// The tiles that `accelerator` is tried on; `None` for all.
pub(super) fn sample_of(
    accelerator: Accelerator,
    scene: &Scene,
    random: &mut Random,
) -> Option<TileSample> {
    let (rays, primitives) = (scene.film.crop.area(), scene.geometry.primitive_count());
    let is_list = accelerator == Accelerator::Tree(SplitMethod::None);
    if !is_list || rays.saturating_mul(primitives) <= MAX_TESTS {
        return None;
    }
    let tiles = rays / u64::from(TILE * TILE);
    let count = (SAMPLE_TESTS / primitives)
        .min(tiles / TILES_FOR_ONE)
        .max(4);
    (count < tiles).then(|| TileSample::new(count, &scene.film.crop, random))
}
