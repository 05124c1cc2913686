//! Times of the parts of a trace.

use super::segment_totals::SegmentTotals;
use std::time::{Duration, Instant};

/// Wall-clock times of the parts of a trace, which follow each other, and the time that threads
/// wait.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct TraceTimes {
    /// Allocates the image, and prepares the view.
    pub prepare: Duration,
    /// Divides the image into rows of tiles, until the first thread begins a segment of a row.
    pub divide: Duration,
    /// Traces tiles: from the beginning of the first segment to the end of the last one.
    pub tiles: Duration,
    /// Adds up the totals of all segments.
    pub join: Duration,
    /// Traces single rays for costs.
    pub single_rays: Duration,
    /// The time in which a thread fills no segment during [`TraceTimes::tiles`], summed over all
    /// threads of the pool.
    pub idle: Duration,
}

impl TraceTimes {
    /// The times of tiles that were divided from `divide` on and joined just now, by `threads`
    /// threads.
    pub(super) fn of_tiles(divide: Instant, totals: &SegmentTotals, threads: usize) -> TraceTimes {
        let tiles = totals.end - totals.begin;
        let threads = u32::try_from(threads).unwrap_or(u32::MAX);
        TraceTimes {
            divide: totals.begin - divide,
            tiles,
            join: totals.end.elapsed(),
            idle: tiles.saturating_mul(threads).saturating_sub(totals.busy),
            ..TraceTimes::default()
        }
    }
}
