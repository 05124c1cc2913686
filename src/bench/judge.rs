//! The exact answers that rows are compared with.

use super::caster::Cast;
use super::pixels::{Answer, some_pixels, strip, strip_of};
use super::random::Random;
use super::{Errors, InputError};
use crate::compare::{Comparison, Tally, difference_picture};
use crate::film::Image;
use crate::progress::Progress;
use crate::reference;
use crate::scene::Scene;

/// Exact tests that are worth waiting for: some seconds on two threads.
const MAX_TESTS: u64 = 4_000_000;

/// Pixels that tell how many tests a pixel takes.
const PILOT: u64 = 256;

/// Exact answers for some pixels of a picture.
#[derive(Debug)]
pub struct Judge {
    /// In film pixels.
    pub(super) pixels: Vec<[u32; 2]>,
    expected: Image,
    /// How far rounding moves what these pixels see, if the scene knows.
    pub(super) input: Option<InputError>,
    /// Pixels of the picture.
    of: u64,
}

/// Whether `scene` has few enough primitives for the reference.
pub fn can_be_judged(scene: &Scene) -> bool {
    scene.geometry.primitive_count() <= reference::MAX_PRIMITIVES
}

/// How many pixels of the picture the reference is asked for: all, if that takes no more tests than are worth waiting for.
pub fn judged_pixels(scene: &Scene) -> u64 {
    let all = scene.film.crop.area();
    let pilot = some_pixels(PILOT, &scene.film.crop, &mut Random::new(SEED));
    let tests = reference::candidates(&scene.camera, &scene.geometry, &pilot)
        .into_iter()
        .sum::<usize>() as u64;
    // A pixel with no test is work, too.
    let share =
        u128::from(MAX_TESTS) * pilot.len() as u128 / u128::from(tests + pilot.len() as u64).max(1);
    all.min(u64::try_from(share).unwrap_or(u64::MAX).max(1))
}

/// All samples start here.
pub(super) const SEED: u64 = 0x5eed;

impl Judge {
    /// For `count` pixels of the picture, chosen at random where these are not all. `progress` counts them.
    pub fn new(scene: &Scene, count: u64, progress: Progress) -> Judge {
        Judge::of_pixels(
            scene,
            some_pixels(count, &scene.film.crop, &mut Random::new(SEED + 1)),
            progress,
        )
    }

    /// For some pixels of the picture.
    pub(super) fn of_pixels(scene: &Scene, pixels: Vec<[u32; 2]>, progress: Progress) -> Judge {
        let Scene {
            camera, geometry, ..
        } = scene;
        let hits = reference::answers(camera, geometry, &pixels, progress);
        let of_pixels = pixels
            .iter()
            .zip(&hits)
            .filter_map(|(pixel, hit)| Some((*pixel, (*hit)?)));
        let input = InputError::of(scene, &of_pixels.collect::<Vec<_>>());
        let answer = |hit: reference::ReferenceHit| Answer {
            z: hit.z,
            t: hit.distance,
            primitive: geometry.image_number(hit.primitive),
        };
        let expected = strip(hits.into_iter().map(|hit| hit.map(answer)));
        Judge {
            pixels,
            expected,
            input,
            of: scene.film.crop.area(),
        }
    }

    /// What is wrong with a picture of the scene's crop that has the usual channels.
    pub fn errors(&self, picture: &Image) -> Errors {
        self.verdict_on(strip_of(picture, &self.pixels)).errors
    }

    /// What is wrong with what came of rays, pixel by pixel and in all.
    pub(super) fn verdict(&self, cast: &Cast) -> Verdict<'_> {
        self.verdict_on(cast.strip(&self.pixels))
    }

    /// Of a strip of the same pixels.
    fn verdict_on(&self, found: Image) -> Verdict<'_> {
        let comparison =
            Comparison::new(&self.expected, &found).expect("strips of the same pixels");
        let tally = Tally::of(&comparison, 0..self.pixels.len());
        Verdict {
            judge: self,
            errors: Errors { tally, of: self.of },
            found,
        }
    }
}

/// What came of a comparison with the exact answers.
pub(super) struct Verdict<'a> {
    judge: &'a Judge,
    /// Counted.
    pub(super) errors: Errors,
    found: Image,
}

impl Verdict<'_> {
    /// The colour of each of the pixels in a picture of differences.
    pub(super) fn colors(&self) -> impl Iterator<Item = ([u32; 2], [u8; 3])> {
        let comparison =
            Comparison::new(&self.judge.expected, &self.found).expect("strips of the same pixels");
        let largest = self.errors.tally.depths.max().unwrap_or(0);
        let colors = difference_picture(&comparison, self.judge.pixels.len(), largest);
        self.judge.pixels.iter().copied().zip(colors)
    }
}
