//! The process: its threads, its signals and its panics.

pub(super) mod panics;
#[cfg(unix)]
pub(super) mod signals;
pub(super) mod threads;
