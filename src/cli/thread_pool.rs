//! The threads that a command works on.

use super::counted::counted;
use super::reporter::Reporter;
use feimos::error::{Diagnostic, Error, ErrorKind, Result};
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// Builds recurse as deep as their trees, up to a hundred levels.
const STACK_BYTES: usize = 8 << 20;

/// A pool of `threads` threads, or of as many as the process may use. Where the system refuses so many, of fewer.
pub(super) fn thread_pool(threads: Option<usize>, reporter: &Reporter) -> Result<ThreadPool> {
    let wanted = threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    let (pool, refused) = largest(wanted, start)?;
    if let Some(refused) = refused {
        let started = counted(pool.current_num_threads() as u64, "thread");
        reporter.note(format_args!(
            "the system refuses {}: {refused}; going on with {started}",
            counted(wanted as u64, "thread")
        ));
    }
    Ok(pool)
}

/// The pool of `wanted` threads, or else of half as many, down to the current thread, and why it has fewer.
fn largest(
    wanted: usize,
    start: impl Fn(usize) -> std::result::Result<ThreadPool, ThreadPoolBuildError>,
) -> Result<(ThreadPool, Option<ThreadPoolBuildError>)> {
    let mut refused = None;
    let mut threads = wanted;
    while threads > 0 {
        match start(threads) {
            Ok(pool) => return Ok((pool, refused)),
            Err(error) => _ = refused.get_or_insert(error),
        }
        threads /= 2;
    }
    let pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
    pool.map(|pool| (pool, refused)).map_err(|error| {
        let diagnostic = Diagnostic::new(format!("cannot start {}: {error}", counted(wanted as u64, "thread")));
        Error::new(ErrorKind::TryAgain, diagnostic.note("try again when fewer programs run"))
    })
}

fn start(threads: usize) -> std::result::Result<ThreadPool, ThreadPoolBuildError> {
    ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_BYTES).build()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A system that has room for this many threads.
    fn with_room_for(most: usize) -> impl Fn(usize) -> std::result::Result<ThreadPool, ThreadPoolBuildError> {
        move |threads| {
            let refuse = || std::io::Error::from(std::io::ErrorKind::WouldBlock);
            let builder = ThreadPoolBuilder::new().num_threads(threads);
            match threads > most {
                true => builder.spawn_handler(|_| Err(refuse())).build(),
                false => builder.build(),
            }
        }
    }

    #[test]
    fn a_pool_has_as_many_threads_as_there_is_room_for() {
        for (wanted, most, expected) in [(3, 9, 3), (8, 5, 4), (8, 1, 1), (7, 0, 1), (1, 0, 1)] {
            // A thread can be the only one of one pool.
            let started = std::thread::spawn(move || {
                let (pool, refused) = largest(wanted, with_room_for(most)).unwrap();
                assert_eq!(refused.is_some(), wanted > most);
                pool.install(|| (rayon::current_num_threads(), rayon::join(|| 1, || 2)))
            });
            assert_eq!(started.join().unwrap(), (expected, (1, 2)));
        }
    }
}
