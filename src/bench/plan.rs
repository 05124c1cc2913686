//! What is to be measured.

use super::Kernel;
use super::pixels::TileSample;
use super::random::Random;
use crate::accel::{BuildOptions, SplitMethod, TILE};
use crate::scene::Scene;

/// Everything that is run on a scene, and how often.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// How to build.
    pub builds: Vec<BuildOptions>,
    /// How to trace, through each of the trees.
    pub kernels: Vec<Kernel>,
    /// How often.
    pub rounds: Rounds,
    /// Whether pictures are wanted, too.
    pub with_pictures: bool,
}

/// How often to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rounds {
    /// Rounds that are not counted.
    pub warmup: usize,
    /// Rounds that are; 1 or more.
    pub runs: usize,
}

impl Plan {
    /// Builds and traces in all, with those that are not timed.
    pub fn steps(&self) -> usize {
        let round = self.builds.len().saturating_mul(1 + self.kernels.len());
        round.saturating_mul(1 + self.rounds.warmup + self.rounds.runs)
    }
}

/// Tests of a primitive in a run, beyond which a list of all of them is tried on some tiles only.
const MAX_TESTS: u64 = 1 << 30;

/// Tests that these tiles take, if each took them once.
const SAMPLE_TESTS: u64 = 1 << 24;

/// Of so many tiles one at most.
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
