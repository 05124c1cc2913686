//! How long things take, for people.

use std::time::Instant;

/// Runs a phase and tells how many milliseconds it took.
pub(super) fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, milliseconds_since(start))
}

/// In thousandths: more digits would be noise.
pub(super) fn milliseconds_since(start: Instant) -> f64 {
    (start.elapsed().as_secs_f64() * 1e6).round() / 1e3
}
