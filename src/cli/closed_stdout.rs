//! Detects a standard output that the caller has closed, as `>&-` does.
//!
//! Rust opens `/dev/null` in the place of a closed descriptor before `main`, so that no file gets
//! its number; what is written then goes nowhere, without an error. A caller may as well have
//! opened `/dev/null`, which is no error. So the descriptor is looked at before Rust does, by a
//! constructor of the program.

use std::sync::atomic::{AtomicBool, Ordering};

static WAS_CLOSED: AtomicBool = AtomicBool::new(false);

/// Returns true if standard output was closed when the program was started.
pub(super) fn was_closed() -> bool {
    WAS_CLOSED.load(Ordering::Relaxed)
}

ctor::declarative::ctor! {
    /// Asks the system alone, and nothing of Rust's library that `main` would have to prepare.
    #[ctor(unsafe)]
    fn look() {
        let flags = rustix::io::fcntl_getfd(rustix::stdio::stdout());
        WAS_CLOSED.store(flags == Err(rustix::io::Errno::BADF), Ordering::Relaxed);
    }
}
