//! The arguments of the command line.

use std::ffi::OsString;
use std::sync::OnceLock;

static ARGUMENTS: OnceLock<Vec<OsString>> = OnceLock::new();

/// Keeps the arguments of this process. Where a program of another language runs the command line,
/// they are not those that the system started it with.
pub(crate) fn keep(arguments: Vec<OsString>) {
    ARGUMENTS.get_or_init(|| arguments);
}

/// The arguments, of which the first is the name of the program.
pub(crate) fn arguments() -> &'static [OsString] {
    ARGUMENTS.get().map_or(&[], Vec::as_slice)
}
