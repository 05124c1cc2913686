//! Makes the parts of a file on all threads and writes them in order.
//!
//! Each thread makes a part in a buffer of its own and writes it when all parts before it are
//! written, while other threads make the next ones. So memory holds one part a thread, and a file
//! grows from its beginning to its end: systems let one thread at a time write to a file anyway.

use rayon::prelude::*;
use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

#[cfg(test)]
mod tests;

/// Bytes of pixels in a part: enough to read and write long pieces, few enough to stay in a core's
/// cache.
pub(super) const PART: usize = 1 << 18;

/// The rows of a part, at least one, if each has `row_bytes` bytes of pixels.
pub(super) fn rows_of_part(row_bytes: usize) -> usize {
    (PART / row_bytes.max(1)).max(1)
}

/// Makes parts 0 to `count` by `make` on the threads of the current rayon pool, each in a buffer
/// that its thread uses again, and passes them to `write` in order.
///
/// # Errors
/// The first error of `make` or `write`. No further part is written.
pub(super) fn write_in_order<B: Default>(
    count: usize,
    make: impl Fn(usize, &mut B) -> io::Result<()> + Sync,
    mut write: impl FnMut(&B) -> io::Result<()> + Send,
) -> io::Result<()> {
    work_in_order(count, &make, &mut write)
}

/// [`write_in_order`], compiled once for each kind of buffer: closures of one type each would
/// compile rayon's long code anew.
fn work_in_order<B: Default>(
    count: usize,
    make: &(dyn Fn(usize, &mut B) -> io::Result<()> + Sync),
    write: &mut (dyn FnMut(&B) -> io::Result<()> + Send),
) -> io::Result<()> {
    let queue = Queue {
        next: AtomicUsize::new(0),
        turn: Mutex::new(Turn {
            part: 0,
            has_failed: false,
            write,
        }),
        changed: Condvar::new(),
    };
    let work = |_| {
        // After an error or a panic, the others must not wait for this thread.
        let mut ending = Ending {
            queue: &queue,
            is_regular: false,
        };
        let mut buffer = B::default();
        loop {
            // Parts are taken in order, so a thread only waits for parts that others are making.
            let part = queue.next.fetch_add(1, Ordering::Relaxed);
            if part >= count {
                break;
            }
            make(part, &mut buffer)?;
            let Some(mut turn) = queue.wait_for(part) else {
                break;
            };
            (turn.write)(&buffer)?;
            turn.part += 1;
            queue.changed.notify_all();
        }
        ending.is_regular = true;
        Ok(())
    };
    let threads = rayon::current_num_threads().min(count);
    let threads = (0..threads).into_par_iter().with_max_len(1);
    threads.try_for_each(work)
}

/// The parts that no thread has taken, and whose turn it is to write.
struct Queue<W> {
    next: AtomicUsize,
    turn: Mutex<Turn<W>>,
    changed: Condvar,
}

struct Turn<W> {
    /// The next part to write.
    part: usize,
    /// A thread has given up: no further part can be written.
    has_failed: bool,
    write: W,
}

impl<W> Queue<W> {
    /// Waits until it is the turn of `part`; `None` if that will never be.
    fn wait_for(&self, part: usize) -> Option<MutexGuard<'_, Turn<W>>> {
        let is_early = |turn: &mut Turn<W>| turn.part != part && !turn.has_failed;
        let turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        let turn = self.changed.wait_while(turn, is_early);
        let turn = turn.unwrap_or_else(PoisonError::into_inner);
        (!turn.has_failed).then_some(turn)
    }
}

/// The end of a thread's work. If it is not regular, all threads end.
struct Ending<'a, W> {
    queue: &'a Queue<W>,
    is_regular: bool,
}

impl<W> Drop for Ending<'_, W> {
    fn drop(&mut self) {
        if !self.is_regular || thread::panicking() {
            let turn = self.queue.turn.lock();
            turn.unwrap_or_else(PoisonError::into_inner).has_failed = true;
            self.queue.changed.notify_all();
        }
    }
}
