//! Totals over segments of an image, and when they were filled.

use crate::accel::ExactFallbacks;
use std::time::{Duration, Instant};

/// Totals over one or more segments.
#[derive(Debug, Clone, Copy)]
pub(super) struct SegmentTotals {
    /// Pixels that hit something.
    pub(super) hits: u64,
    pub(super) fallbacks: ExactFallbacks,
    /// When the first segment was begun.
    pub(super) begin: Instant,
    /// When the last segment was done.
    pub(super) end: Instant,
    /// The sum of the times of all segments.
    pub(super) busy: Duration,
}

impl SegmentTotals {
    /// The totals of a segment that was begun at `begin` and is done now.
    pub(super) fn since(begin: Instant, hits: u64, fallbacks: ExactFallbacks) -> SegmentTotals {
        let end = Instant::now();
        SegmentTotals {
            hits,
            fallbacks,
            begin,
            end,
            busy: end - begin,
        }
    }

    /// The sum of both totals.
    pub(super) fn plus(mut self, other: SegmentTotals) -> SegmentTotals {
        self.hits += other.hits;
        self.fallbacks += other.fallbacks;
        self.begin = self.begin.min(other.begin);
        self.end = self.end.max(other.end);
        self.busy += other.busy;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::super::trace_times::TraceTimes;
    use super::*;

    #[test]
    fn threads_without_a_segment_are_idle() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let segment = |[begin, end]: [u64; 2]| SegmentTotals {
            hits: 1,
            fallbacks: ExactFallbacks::default(),
            begin: at(begin),
            end: at(end),
            busy: at(end) - at(begin),
        };
        // One thread fills two segments, another one a third.
        let segments = [[3, 6], [1, 5], [5, 9]].map(segment);
        let totals = segments.into_iter().reduce(SegmentTotals::plus).unwrap();
        let times = TraceTimes::of_tiles(start, &totals, 2);
        assert_eq!(totals.hits, 3);
        let parts = [times.divide, times.tiles, times.idle].map(|part| part.as_millis());
        assert_eq!(parts, [1, 8, 2 * 8 - (3 + 4 + 4)]);
    }
}
