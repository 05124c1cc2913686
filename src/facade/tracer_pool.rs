//! The memory of tracers, kept from ray to ray.

use crate::accel::TracerMemory;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Memory for as many tracers as have ever traced at once. All are of one geometry.
#[derive(Default)]
pub(super) struct TracerPool(Mutex<Vec<TracerMemory>>);

impl TracerPool {
    pub(super) fn take(&self) -> TracerMemory {
        self.lock().pop().unwrap_or_default()
    }

    pub(super) fn give_back(&self, memory: TracerMemory) {
        self.lock().push(memory);
    }

    #[cfg(test)]
    pub(super) fn count(&self) -> usize {
        self.lock().len()
    }

    /// Nothing panics while the list is locked.
    fn lock(&self) -> MutexGuard<'_, Vec<TracerMemory>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
