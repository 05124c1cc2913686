//! Results, on standard output.

#[cfg(unix)]
use super::closed_stdout::was_closed;
use feimos::error::{Error, Result};
use feimos::json;
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// # Errors
/// A standard output that the caller has closed: what is written to it would go nowhere.
pub(super) fn check() -> Result<()> {
    if was_closed() {
        Err(failed(closed()))
    } else {
        Ok(())
    }
}

/// As [`check`], where something is to be written.
pub(super) fn check_if(is_wanted: bool) -> Result<()> {
    if is_wanted { check() } else { Ok(()) }
}

#[cfg(unix)]
fn closed() -> io::Error {
    rustix::io::Errno::BADF.into()
}

/// Elsewhere writing fails by itself.
#[cfg(not(unix))]
fn was_closed() -> bool {
    false
}

#[cfg(not(unix))]
fn closed() -> io::Error {
    io::ErrorKind::Unsupported.into()
}

/// Writes all of `bytes`, unless making them failed.
pub(super) fn write_to_stdout(bytes: io::Result<Vec<u8>>) -> Result<()> {
    let bytes = bytes.map_err(failed)?;
    check()?;
    let mut stdout = io::stdout().lock();
    stdout
        .write_all(&bytes)
        .and_then(|()| stdout.flush())
        .map_err(failed)
}

/// Writes one line of JSON.
pub(super) fn write_json_line(value: &impl Serialize) -> Result<()> {
    write_to_stdout(Ok(json::line(value)))
}

/// The error of writing to it.
pub(super) fn failed(error: io::Error) -> Error {
    Error::writing(Path::new("standard output"), &error)
}
