//! Wall-clock times of the phases of an image.

use serde::Serialize;
use std::time::Instant;

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

/// Runs `work` and measures its milliseconds.
pub(super) fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, milliseconds_since(start))
}

pub(super) fn milliseconds_since(start: Instant) -> f64 {
    (start.elapsed().as_secs_f64() * 1e6).round() / 1e3
}
