//! The thread pool of a command.

use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::words::counted;
use crate::error::{Diagnostic, Error, ErrorKind, Result};
use rayon::{ThreadBuilder, ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::io;
use std::thread::JoinHandle;

/// Builders recurse as deep as their trees, up to a hundred levels.
const STACK_BYTES: usize = 8 << 20;

/// Starts a pool of `threads` threads, by default as many as the process may use. If the system
/// refuses so many, the pool has fewer.
pub(crate) fn thread_pool(threads: Option<usize>, reporter: &Reporter) -> Result<ThreadPool> {
    let available = || std::thread::available_parallelism().map_or(1, usize::from);
    let wanted = threads.unwrap_or_else(available);
    let (pool, refused) = largest(wanted, spawn)?;
    if let Some(refused) = refused {
        let wanted = counted(wanted as u64, "thread");
        let started = counted(pool.current_num_threads() as u64, "thread");
        reporter.note(format_args!(
            "the system refuses {wanted}: {refused}; continuing with {started}"
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

/// Starts a pool of `wanted` threads, or of fewer, down to the current thread alone; also returns
/// why it has fewer.
fn largest(wanted: usize, spawn: Spawn) -> Result<(ThreadPool, Option<ThreadPoolBuildError>)> {
    let mut refused = None;
    let mut threads = wanted;
    while threads > 0 {
        match start(threads, spawn) {
            Ok(pool) => return Ok((pool, refused)),
            Err((error, started)) => {
                refused.get_or_insert(error);
                // Half of what was possible: the rest of the program and other programs need some.
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
        let diagnostic = diagnostic.note("try again when fewer programs run");
        Error::new(ErrorKind::TryAgain, diagnostic)
    })
}

/// Starts a pool of exactly `threads` threads; the error counts how many were possible.
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
        // They end by themselves, but use resources until then.
        started.into_iter().for_each(|thread| _ = thread.join());
        (error, count)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Threads that the system still allows.
    static ROOM: AtomicUsize = AtomicUsize::new(0);

    fn spawn_if_there_is_room(thread: ThreadBuilder) -> io::Result<JoinHandle<()>> {
        let take = |room: usize| room.checked_sub(1);
        ROOM.fetch_update(Ordering::SeqCst, Ordering::SeqCst, take)
            .map_err(|_| io::ErrorKind::WouldBlock)?;
        std::thread::Builder::new().spawn(|| {
            thread.run();
            ROOM.fetch_add(1, Ordering::SeqCst);
        })
    }

    #[test]
    fn a_pool_has_fewer_threads_if_the_system_refuses_some() {
        let cases = [
            (3, 9, 3),
            (8, 5, 3),
            (8, 1, 1),
            (2, 1, 1),
            (7, 0, 1),
            (1, 0, 1),
        ];
        for (wanted, room, expected) in cases {
            ROOM.store(room, Ordering::SeqCst);
            // A thread can work for one pool only.
            let check = move || {
                let (pool, refused) = largest(wanted, spawn_if_there_is_room).unwrap();
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
