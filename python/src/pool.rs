//! Thread pools, which belong to a process: a fork has none of its parent's threads.

use super::error::of_class;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::mem;
use std::sync::{Arc, Mutex, PoisonError};

/// Builders recurse as deep as their trees, up to a hundred levels.
const STACK_BYTES: usize = 8 << 20;

/// The largest number of threads, as of the program.
const MAX_THREADS: usize = 4096;

/// Pools that are kept for further calls.
const MAX_POOLS: usize = 4;

/// The pools of the process `process`, the latest last.
struct Pools {
    process: u32,
    pools: Vec<(usize, Arc<ThreadPool>)>,
}

/// Locked only by threads that are attached to the interpreter, as is one that forks: so no fork
/// begins with a lock that nobody opens.
static POOLS: Mutex<Pools> = Mutex::new(Pools {
    process: 0,
    pools: Vec::new(),
});

/// The pool of `threads` threads, by default as many as the process may use.
///
/// # Errors
/// The number is out of range, or the system refuses even one thread.
pub(super) fn pool(py: Python<'_>, threads: Option<usize>) -> PyResult<Arc<ThreadPool>> {
    let wanted = match threads {
        None => std::thread::available_parallelism().map_or(1, usize::from),
        Some(threads) if (1..=MAX_THREADS).contains(&threads) => threads,
        Some(threads) => {
            let message = format!("threads: expected 1 to {MAX_THREADS}, found {threads}");
            return Err(of_class(py, "ArgumentError", message));
        }
    };
    let mut all = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    if all.process != std::process::id() {
        // Dropping them would wait for threads that this process does not have.
        mem::forget(mem::take(&mut all.pools));
        all.process = std::process::id();
    }
    if let Some((_, pool)) = all.pools.iter().find(|(threads, _)| *threads == wanted) {
        return Ok(Arc::clone(pool));
    }
    let pool = Arc::new(start(wanted).map_err(|message| of_class(py, "ResourceError", message))?);
    if all.pools.len() == MAX_POOLS {
        // Its threads end when their work is done.
        all.pools.remove(0);
    }
    all.pools.push((wanted, Arc::clone(&pool)));
    Ok(pool)
}

/// Starts `wanted` threads, or fewer if the system refuses so many.
fn start(wanted: usize) -> Result<ThreadPool, String> {
    let mut threads = wanted;
    loop {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .stack_size(STACK_BYTES)
            .thread_name(|number| format!("feimos-{number}"))
            .build();
        match pool {
            Ok(pool) => return Ok(pool),
            Err(_) if threads > 1 => threads /= 2,
            Err(error) => return Err(format!("cannot start a thread: {error}")),
        }
    }
}
