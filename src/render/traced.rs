//! The outcome of rendering: hits, exact fallbacks and times.

use super::trace_times::TraceTimes;
use crate::accel::ExactFallbacks;

/// Totals over the rays of an image.
#[derive(Debug, Clone, Copy, Default)]
pub struct Traced {
    /// Pixels that hit something.
    pub hits: u64,
    /// The number of exact fallbacks.
    pub fallbacks: ExactFallbacks,
    /// The time that each part took.
    pub times: TraceTimes,
}

impl Traced {
    /// The sum of both totals, with the times of the first.
    pub(super) fn plus(mut self, other: Traced) -> Traced {
        self.hits += other.hits;
        self.fallbacks += other.fallbacks;
        self
    }
}
