//! Counts of wrong answers.

use super::confidence::confidence_interval;
use crate::compare::Tally;

/// The errors of answers against exact ones: wrong decisions, and errors of depths.
#[derive(Debug, Clone, PartialEq)]
pub struct Errors {
    /// Counts over the pixels that were compared.
    pub tally: Tally,
    /// Pixels of the image.
    pub of: u64,
}

impl Errors {
    /// Returns true if only a sample of the pixels was compared.
    pub fn is_sampled(&self) -> bool {
        self.tally.pixels < self.of
    }

    /// The 95 % confidence interval of the share of all pixels that `count` pixels of the sample
    /// stand for; `None` if all pixels were compared.
    pub fn confidence(&self, count: u64) -> Option<[f64; 2]> {
        self.is_sampled()
            .then(|| confidence_interval(count, self.tally.pixels))
    }

    /// The share of pixels with a wrong decision.
    pub fn wrong_share(&self) -> f64 {
        self.tally.wrong_decisions() as f64 / self.tally.pixels.max(1) as f64
    }
}
