//! The outcome of rendering: hits, traversal counts and exact fallbacks.

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
}

impl Traced {
    /// The sum of both totals.
    pub(super) fn plus(mut self, other: Traced) -> Traced {
        self.hits += other.hits;
        self.fallbacks += other.fallbacks;
        if let Some(counts) = other.counts {
            *self.counts.get_or_insert_default() += counts;
        }
        self
    }
}
