//! Spreads of the times of the parts of a trace.

use super::spread::Spread;
use crate::render::TraceTimes;
use std::time::Duration;

/// The parts of [`super::Row::trace_ms`], in milliseconds: see [`TraceTimes`]. They are spreads of
/// their own: the median of a part need not belong to the median run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceParts {
    /// Allocates the image, and prepares the view.
    pub prepare: Spread,
    /// Divides the image.
    pub divide: Spread,
    /// Traces tiles.
    pub tiles: Spread,
    /// Adds up totals.
    pub join: Spread,
    /// The time that threads wait while tiles are traced, summed over all threads.
    pub idle: Spread,
}

impl TraceParts {
    /// The spreads over several runs; `None` if there are none.
    pub(super) fn of(runs: &[TraceTimes]) -> Option<TraceParts> {
        let spread = |part: fn(&TraceTimes) -> Duration| {
            let ms = runs.iter().map(|run| part(run).as_secs_f64() * 1e3);
            Spread::of(ms.collect())
        };
        Some(TraceParts {
            prepare: spread(|run| run.prepare)?,
            divide: spread(|run| run.divide)?,
            tiles: spread(|run| run.tiles)?,
            join: spread(|run| run.join)?,
            idle: spread(|run| run.idle)?,
        })
    }

    /// The sum of both, part by part.
    pub(super) fn plus(self, other: TraceParts) -> TraceParts {
        TraceParts {
            prepare: self.prepare.plus(other.prepare),
            divide: self.divide.plus(other.divide),
            tiles: self.tiles.plus(other.tiles),
            join: self.join.plus(other.join),
            idle: self.idle.plus(other.idle),
        }
    }
}
