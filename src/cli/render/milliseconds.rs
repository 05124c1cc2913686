//! Wall-clock times of the phases of an image.

use crate::render::TraceTimes;
use serde::Serialize;
use std::time::{Duration, Instant};

/// Times in milliseconds, in thousandths: more digits would be noise.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub(super) struct Milliseconds {
    /// From the scene file to geometry.
    pub(super) load: f64,
    /// From geometry to the aggregate.
    pub(super) build: f64,
    /// From rays to channels.
    pub(super) trace: f64,
    /// From channels to the file.
    pub(super) write: f64,
    pub(super) total: f64,
}

/// Times of the parts of a trace in milliseconds. Field names are keys of JSON.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct TraceMilliseconds {
    prepare: f64,
    divide: f64,
    tiles: f64,
    join: f64,
    single_rays: f64,
    /// Summed over all threads.
    idle: f64,
}

impl TraceMilliseconds {
    pub(super) fn new(times: TraceTimes) -> TraceMilliseconds {
        TraceMilliseconds {
            prepare: milliseconds(times.prepare),
            divide: milliseconds(times.divide),
            tiles: milliseconds(times.tiles),
            join: milliseconds(times.join),
            single_rays: milliseconds(times.single_rays),
            idle: milliseconds(times.idle),
        }
    }
}

/// Runs `work` and measures its milliseconds.
pub(super) fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, milliseconds_since(start))
}

pub(super) fn milliseconds_since(start: Instant) -> f64 {
    milliseconds(start.elapsed())
}

fn milliseconds(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e6).round() / 1e3
}
