//! Memory that the system refuses: an exit code of its own.

use feimos::error::ErrorKind;
use signal_hook::consts::SIGABRT;
use signal_hook::flag::register_conditional_shutdown;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// From now on the exit code of memory that is refused is that of what may pass.
///
/// Large sizes are compared with what is left before they are asked for, and many small ones are not. Where one is refused the standard
/// library says how many bytes it was, on standard error, and ends the program by SIGABRT. Nothing else in feimos does so, but for
/// a panic within a panic.
pub(super) fn end_with_its_own_code() {
    let code = ErrorKind::TryAgain.exit_code().into();
    // Where there can be no handler the program ends all the same.
    let _ = register_conditional_shutdown(SIGABRT, code, Arc::new(AtomicBool::new(true)));
}
