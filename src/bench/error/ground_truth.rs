//! Ground truth: the exact answers that rows are compared with.

use super::errors::Errors;
use super::input_rounding::InputError;
use crate::bench::trace::{Answer, Cast, Random, some_pixels, strip, strip_of};
use crate::compare::{Comparison, Tally, difference_picture};
use crate::film::Image;
use crate::progress::Progress;
use crate::reference::{self, ReferenceHit};
use crate::scene::Scene;

/// Exact tests that are worth waiting for: some seconds on two threads.
const MAX_TESTS: u64 = 4_000_000;

/// Pixels that estimate how many tests a pixel takes.
const PILOT: u64 = 256;

/// The seed of all samples.
pub(crate) const SEED: u64 = 0x5eed;

/// Exact answers for some pixels of an image.
#[derive(Debug)]
pub struct GroundTruth {
    /// In film coordinates.
    pixels: Vec<[u32; 2]>,
    expected: Image,
    /// How far rounding moves what these pixels see, if the scene was read with bounds.
    pub(crate) input: Option<InputError>,
    /// Pixels of the image.
    of: u64,
}

/// Returns true if `scene` has few enough primitives for exact answers.
pub fn has_ground_truth(scene: &Scene) -> bool {
    scene.geometry.primitive_count() <= reference::MAX_PRIMITIVES
}

impl GroundTruth {
    /// The number of pixels of the image to compute exact answers for: all, unless that takes too
    /// many tests.
    pub fn affordable_pixels(scene: &Scene) -> u64 {
        let all = scene.film.crop.area();
        let pilot = some_pixels(PILOT, &scene.film.crop, &mut Random::new(SEED));
        let candidates = reference::candidates(&scene.camera, &scene.geometry, &pilot);
        // A pixel without a test is work, too.
        let work = candidates.into_iter().sum::<usize>() as u64 + pilot.len() as u64;
        let count = u128::from(MAX_TESTS) * pilot.len() as u128 / u128::from(work).max(1);
        all.min(u64::try_from(count).unwrap_or(u64::MAX).max(1))
    }

    /// Computes exact answers for `count` pixels of the image, a random sample unless these are
    /// all. `progress` counts them.
    pub fn new(scene: &Scene, count: u64, progress: Progress) -> GroundTruth {
        let pixels = some_pixels(count, &scene.film.crop, &mut Random::new(SEED + 1));
        GroundTruth::of_pixels(scene, pixels, progress)
    }

    /// Computes exact answers for these pixels of the image.
    pub(crate) fn of_pixels(
        scene: &Scene,
        pixels: Vec<[u32; 2]>,
        progress: Progress,
    ) -> GroundTruth {
        let Scene {
            camera, geometry, ..
        } = scene;
        let answers = reference::answers(camera, geometry, &pixels, progress);
        let found = pixels.iter().zip(&answers);
        let hits: Vec<_> = found
            .filter_map(|(pixel, hit)| Some((*pixel, (*hit)?)))
            .collect();
        let answer = |hit: ReferenceHit| Answer {
            z: hit.z,
            t: hit.distance,
            primitive: geometry.image_number(hit.primitive),
        };
        GroundTruth {
            pixels,
            expected: strip(answers.into_iter().map(|hit| hit.map(answer))),
            input: InputError::of(scene, &hits),
            of: scene.film.crop.area(),
        }
    }

    /// Counts the errors of an image of the scene's crop, which has the usual channels.
    pub fn errors(&self, image: &Image) -> Errors {
        self.check_strip(strip_of(image, &self.pixels)).errors
    }

    /// Compares the answers of a kernel.
    pub(crate) fn check(&self, cast: &Cast) -> Checked<'_> {
        self.check_strip(cast.strip(&self.pixels))
    }

    /// Compares a strip of the same pixels.
    fn check_strip(&self, found: Image) -> Checked<'_> {
        let comparison = self.comparison(&found);
        let tally = Tally::of(&comparison, 0..self.pixels.len());
        let errors = Errors { tally, of: self.of };
        Checked {
            truth: self,
            errors,
            found,
        }
    }

    fn comparison<'a>(&'a self, found: &'a Image) -> Comparison<'a> {
        Comparison::new(&self.expected, found).expect("strips of the same pixels")
    }
}

/// Answers that were compared with the ground truth.
pub(crate) struct Checked<'a> {
    truth: &'a GroundTruth,
    pub(crate) errors: Errors,
    found: Image,
}

impl Checked<'_> {
    /// The compared pixels and their colours in a picture of differences.
    pub(crate) fn colors(&self) -> impl Iterator<Item = ([u32; 2], [u8; 3])> {
        let pixels = &self.truth.pixels;
        let largest = self.errors.tally.depths.max().unwrap_or(0);
        let comparison = self.truth.comparison(&self.found);
        let colors = difference_picture(&comparison, pixels.len(), largest);
        pixels.iter().copied().zip(colors)
    }
}
