//! Counts of pixels by their difference.

use super::comparison::{Comparison, Difference};
use super::ulps::Ulps;

/// Counts of pixels, each by its [difference](Difference).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tally {
    /// Pixels that were compared.
    pub pixels: u64,
    /// Hits, but misses were expected.
    pub false_hits: u64,
    /// Misses, but hits were expected.
    pub missed_hits: u64,
    /// Hits of the wrong primitive.
    pub wrong_primitives: u64,
    /// Errors of the depths of other hits, except for those below.
    pub depths: Ulps,
    /// Errors of the surfaces of hits, if they are worse than the depth.
    pub surfaces: Ulps,
}

impl Tally {
    /// Counts some pixels of a comparison.
    pub fn of(comparison: &Comparison, pixels: impl Iterator<Item = usize>) -> Tally {
        let mut tally = Tally::default();
        for pixel in pixels {
            tally.pixels += 1;
            match comparison.difference(pixel) {
                Difference::FalseHit => tally.false_hits += 1,
                Difference::MissedHit => tally.missed_hits += 1,
                Difference::WrongPrimitive => tally.wrong_primitives += 1,
                Difference::Depth(ulps) => tally.depths.add(ulps),
                Difference::Surface(ulps) => tally.surfaces.add(ulps),
                Difference::None if comparison.is_hit(pixel) && comparison.has_depths() => {
                    tally.depths.add(0)
                }
                Difference::None => {}
            }
        }
        tally
    }

    /// False and missed hits.
    pub fn wrong_hits(&self) -> u64 {
        self.false_hits + self.missed_hits
    }

    /// Pixels with a wrong hit or a wrong primitive.
    pub fn wrong_decisions(&self) -> u64 {
        self.wrong_hits() + self.wrong_primitives
    }

    /// Pixels that differ by more than `max_ulp` units in the last place, or in their decision.
    pub fn different(&self, max_ulp: u32) -> u64 {
        self.wrong_decisions() + self.depths.above(max_ulp) + self.surfaces.above(max_ulp)
    }

    /// The largest error of a depth or a surface.
    pub fn max_ulps(&self) -> u32 {
        self.depths.max().max(self.surfaces.max()).unwrap_or(0)
    }

    /// Adds the counts of other pixels.
    pub fn merge(&mut self, other: &Tally) {
        self.pixels += other.pixels;
        self.false_hits += other.false_hits;
        self.missed_hits += other.missed_hits;
        self.wrong_primitives += other.wrong_primitives;
        self.depths.merge(&other.depths);
        self.surfaces.merge(&other.surfaces);
    }
}
