//! One tile tracer for each thread, kept from segment to segment.

use crate::accel::{TileTracer, Tiles};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The tracers of the threads of a pool. Rayon forgets what a thread has made whenever it splits
/// the work, which is once a segment on small images, and a tracer has large buffers.
pub(super) struct Tracers<'a> {
    tiles: &'a Tiles<'a>,
    /// The tracer of each thread, from its first segment on, while the thread does not use it.
    of_threads: Vec<Mutex<Option<Box<TileTracer<'a>>>>>,
}

impl<'a> Tracers<'a> {
    /// For the threads of the current pool.
    pub(super) fn new(tiles: &'a Tiles<'a>) -> Tracers<'a> {
        let threads = 0..rayon::current_num_threads();
        Tracers {
            tiles,
            of_threads: threads.map(|_| Mutex::default()).collect(),
        }
    }

    /// Calls `work` with the tracer of the current thread.
    pub(super) fn with<T>(&self, work: impl FnOnce(&mut TileTracer<'a>) -> T) -> T {
        let thread = rayon::current_thread_index();
        let own = thread.and_then(|thread| self.of_threads.get(thread));
        let kept = own.and_then(|own| lock(own).take());
        let mut tracer = kept.unwrap_or_else(|| Box::new(self.tiles.tracer()));
        let result = work(&mut tracer);
        if let Some(own) = own {
            *lock(own) = Some(tracer);
        }
        result
    }
}

/// A panic loses the tracer that it interrupts, and leaves the lock as it should be.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
