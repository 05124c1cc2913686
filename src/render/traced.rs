//! The outcome of rendering: hits, traversal counts and exact fallbacks.

use super::trace_times::TraceTimes;
use crate::accel::{ExactFallbacks, TraversalCounts};

/// Totals over the rays of an image.
#[derive(Debug, Clone, Copy, Default)]
pub struct Traced {
    /// Pixels that hit something.
    pub hits: u64,
    /// The nodes and primitives that all rays tested, if counted.
    pub counts: Option<TraversalCounts>,
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
        if let Some(counts) = other.counts {
            *self.counts.get_or_insert_default() += counts;
        }
        self
    }
}
