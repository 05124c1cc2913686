//! How many pixels are wrong, and how.

use super::{Comparison, Difference, Ulps};

/// Counts of pixels, each in one place: by what is [wrong with it](Difference).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tally {
    /// Pixels that were compared.
    pub pixels: u64,
    /// Of these, hits where misses were expected.
    pub false_hits: u64,
    /// Misses where hits were expected.
    pub missed_hits: u64,
    /// Hits of something else.
    pub wrong_primitives: u64,
    /// Errors of the depths of all other hits, but for these:
    pub depths: Ulps,
    /// Errors of what surfaces are like, of hits where that is farther off than their depth.
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
                Difference::Primitive(ulps) => tally.surfaces.add(ulps),
                Difference::None if comparison.is_hit(pixel) && comparison.has_depths() => {
                    tally.depths.add(0)
                }
                Difference::None => {}
            }
        }
        tally
    }

    /// Hits for misses and misses for hits.
    pub fn wrong_hits(&self) -> u64 {
        self.false_hits + self.missed_hits
    }

    /// Pixels with the wrong answer to what is hit, if anything.
    pub fn wrong_decisions(&self) -> u64 {
        self.wrong_hits() + self.wrong_primitives
    }

    /// Pixels that differ, where depths and surfaces may be off by `max_ulp` units in the last place.
    pub fn different(&self, max_ulp: u32) -> u64 {
        self.wrong_decisions() + self.depths.above(max_ulp) + self.surfaces.above(max_ulp)
    }

    /// The largest error of a depth, or of what a surface is like.
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
