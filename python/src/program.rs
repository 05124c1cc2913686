//! The program `feimos`, which the wheel starts from Python.

use pyo3::prelude::*;
use std::ffi::OsString;
use std::io::{self, Write};

/// Run the command line and return its exit code. The first argument is the name of the program.
#[pyfunction]
pub(super) fn run(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| {
        #[cfg(target_os = "linux")]
        feimos::huge_pages::prepare();
        let code = feimos::cli::run(arguments);
        // Only the `main` of a native program flushes at its end. A reader that has gone misses
        // nothing.
        let _ = io::stdout().flush();
        code
    })
}
