//! Work on the threads of a pool, while other threads of Python run and Ctrl-C ends it.

use super::error::{exception, of_class};
use super::pool::pool;
use feimos::Error;
use feimos::progress::Progress;
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// The time between two looks for signals.
const POLL: Duration = Duration::from_millis(20);

/// How long an interrupted call waits for its work to end.
const PATIENCE: Duration = Duration::from_millis(100);

/// Does `work` on a pool of `threads` threads.
///
/// If a signal handler raises an exception, as that of SIGINT does, the work is cancelled. It owns
/// its data, so that it may end a little later than this call.
///
/// # Errors
/// Those of the work; its panic; the exception of a signal handler.
pub(super) fn run<T: Send + 'static>(
    py: Python<'_>,
    threads: Option<usize>,
    work: impl FnOnce(Progress) -> Result<T, Error> + Send + 'static,
) -> PyResult<T> {
    let pool = pool(py, threads)?;
    let cancel = Arc::new(AtomicBool::new(false));
    let is_cancelled = Arc::clone(&cancel);
    let (sender, mut receiver) = channel();
    pool.spawn(move || {
        let progress = Progress::SILENT.cancelled_by(&is_cancelled);
        let outcome = catch_unwind(AssertUnwindSafe(|| work(progress)));
        // After an interrupt nobody may be left who takes it.
        let _ = sender.send(outcome);
    });
    loop {
        let (received, back) = py.detach(move || (receiver.recv_timeout(POLL), receiver));
        receiver = back;
        match received {
            Ok(Ok(result)) => return result.map_err(|error| exception(py, &error)),
            Ok(Err(panic)) => return Err(panicked(py, &*panic)),
            Err(RecvTimeoutError::Disconnected) => return Err(panicked(py, &"no result")),
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(raised) = py.check_signals() {
            cancel.store(true, Ordering::Relaxed);
            py.detach(move || _ = receiver.recv_timeout(PATIENCE));
            return Err(raised);
        }
    }
}

/// Does short `work` on this thread, while other threads of Python run.
///
/// # Errors
/// Its panic.
pub(super) fn run_here<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let outcome = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
    outcome.map_err(|panic| panicked(py, &*panic))
}

/// The exception for a panic. Its hook has printed where it happened.
fn panicked(py: Python<'_>, panic: &(dyn Any + Send)) -> PyErr {
    let owned = || panic.downcast_ref::<String>().map(String::as_str);
    let text = panic.downcast_ref::<&str>().copied().or_else(owned);
    let message = format!(
        "internal error: {}\n   = this is a bug in feimos: please report it with the scene",
        text.unwrap_or("no message")
    );
    of_class(py, "InternalError", message)
}
