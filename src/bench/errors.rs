//! How wrong the answers of a row are.

use super::confidence_interval;
use crate::compare::Tally;

/// How far answers are from the exact ones, by kinds: decisions and depths.
#[derive(Debug, Clone, PartialEq)]
pub struct Errors {
    /// Counts over the pixels whose exact answer was worked out.
    pub tally: Tally,
    /// Pixels of the picture.
    pub of: u64,
}

impl Errors {
    /// Whether only some of the pixels were looked at.
    pub fn is_sampled(&self) -> bool {
        self.tally.pixels < self.of
    }

    /// Between which shares of all pixels the share of something lies of which `count` were found; `None` where all were looked at.
    pub fn confidence(&self, count: u64) -> Option<[f64; 2]> {
        self.is_sampled()
            .then(|| confidence_interval(count, self.tally.pixels))
    }

    /// The share of pixels with a wrong decision.
    pub fn wrong_share(&self) -> f64 {
        self.tally.wrong_decisions() as f64 / self.tally.pixels.max(1) as f64
    }
}
