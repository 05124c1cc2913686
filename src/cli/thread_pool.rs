//! The threads that a command works on.

use super::counted::counted;
use super::reporter::Reporter;
use feimos::error::{Diagnostic, Error, ErrorKind, Result};
use rayon::{ThreadBuilder, ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::io;
use std::thread::JoinHandle;

/// Builds recurse as deep as their trees, up to a hundred levels.
const STACK_BYTES: usize = 8 << 20;

/// A pool of `threads` threads, or of as many as the process may use. Where the system refuses so
/// many, of fewer.
pub(super) fn thread_pool(threads: Option<usize>, reporter: &Reporter) -> Result<ThreadPool> {
    let wanted =
        threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    let (pool, refused) = largest(wanted, spawn)?;
    if let Some(refused) = refused {
        let wanted = counted(wanted as u64, "thread");
        let started = counted(pool.current_num_threads() as u64, "thread");
        reporter.note(format_args!(
            "the system refuses {wanted}: {refused}; going on with {started}"
        ));
    }
    Ok(pool)
}

/// Starts a thread of a pool.
type Spawn = fn(ThreadBuilder) -> io::Result<JoinHandle<()>>;

fn spawn(thread: ThreadBuilder) -> io::Result<JoinHandle<()>> {
    std::thread::Builder::new()
        .stack_size(STACK_BYTES)
        .spawn(|| thread.run())
}

/// The pool of `wanted` threads, or else of fewer, down to the current thread, and why it has
/// fewer.
fn largest(wanted: usize, spawn: Spawn) -> Result<(ThreadPool, Option<ThreadPoolBuildError>)> {
    let mut refused = None;
    let mut threads = wanted;
    while threads > 0 {
        match start(threads, spawn) {
            Ok(pool) => return Ok((pool, refused)),
            Err((error, started)) => {
                refused.get_or_insert(error);
                // Half of those that there was room for: the rest of the program, and others, need
                // some.
                threads = started.div_ceil(2).min(threads - 1);
            }
        }
    }
    let pool = ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build();
    pool.map(|pool| (pool, refused)).map_err(|error| {
        let diagnostic = Diagnostic::new(format!(
            "cannot start {}: {error}",
            counted(wanted as u64, "thread")
        ));
        Error::new(
            ErrorKind::TryAgain,
            diagnostic.note("try again when fewer programs run"),
        )
    })
}

/// A pool of so many threads; where one is refused, how many there was room for.
fn start(
    threads: usize,
    spawn: Spawn,
) -> std::result::Result<ThreadPool, (ThreadPoolBuildError, usize)> {
    let mut started = Vec::new();
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .spawn_handler(|thread| {
            started.push(spawn(thread)?);
            Ok(())
        });
    pool.build().map_err(|error| {
        let count = started.len();
        // They end by themselves, and take the place of others until they have.
        started.into_iter().for_each(|thread| _ = thread.join());
        (error, count)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Threads that there is room for.
    static ROOM: AtomicUsize = AtomicUsize::new(0);

    fn spawn_where_there_is_room(thread: ThreadBuilder) -> io::Result<JoinHandle<()>> {
        let take = |room: usize| room.checked_sub(1);
        ROOM.fetch_update(Ordering::SeqCst, Ordering::SeqCst, take)
            .map_err(|_| io::ErrorKind::WouldBlock)?;
        std::thread::Builder::new().spawn(|| {
            thread.run();
            ROOM.fetch_add(1, Ordering::SeqCst);
        })
    }

    #[test]
    fn a_pool_has_fewer_threads_where_there_is_no_room() {
        for (wanted, room, expected) in [
            (3, 9, 3),
            (8, 5, 3),
            (8, 1, 1),
            (2, 1, 1),
            (7, 0, 1),
            (1, 0, 1),
        ] {
            ROOM.store(room, Ordering::SeqCst);
            // A thread can work for one pool only.
            let check = move || {
                let (pool, refused) = largest(wanted, spawn_where_there_is_room).unwrap();
                assert_eq!(refused.is_some(), wanted > room);
                assert_eq!(
                    pool.install(|| (rayon::current_num_threads(), rayon::join(|| 1, || 2))),
                    (expected, (1, 2))
                );
                drop(pool);
            };
            std::thread::spawn(check).join().unwrap();
            let start = std::time::Instant::now();
            while ROOM.load(Ordering::SeqCst) < room && start.elapsed().as_secs() < 60 {
                std::thread::yield_now();
            }
        }
    }
}
