//! The threads that a command works on.

use feimos::error::{Diagnostic, Error, ErrorKind, Result};

/// Builds recurse as deep as their trees, up to a hundred levels.
const STACK_BYTES: usize = 8 << 20;

/// A pool of `threads` threads, or of as many as the process may use.
pub(super) fn thread_pool(threads: Option<usize>) -> Result<rayon::ThreadPool> {
    let threads = threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_BYTES).build().map_err(|error| {
        let diagnostic = Diagnostic::new(format!("cannot start {threads} threads: {error}"));
        Error::new(ErrorKind::TryAgain, diagnostic.note("use fewer, with --threads"))
    })
}
