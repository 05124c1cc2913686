//! Standard output: writes results, and detects that the caller has closed it.

use crate::error::{Error, Result};
use crate::json;
use serde::Serialize;
use std::fs::{File, Metadata};
use std::io::{self, IsTerminal, Write};
use std::path::Path;

/// # Errors
/// The caller has closed standard output, as `>&-` does: output would be lost.
pub(crate) fn check() -> Result<()> {
    if closed::was_closed() {
        return Err(failed(closed::error()));
    }
    Ok(())
}

/// Like [`check`], if the command writes to standard output.
pub(crate) fn check_if(is_used: bool) -> Result<()> {
    if is_used { check() } else { Ok(()) }
}

/// # Errors
/// Standard output is a terminal, which binary data would confuse.
pub(crate) fn check_binary() -> Result<()> {
    match io::stdout().is_terminal() {
        true => Err(is_terminal("-o -: standard output")),
        false => Ok(()),
    }
}

/// # Errors
/// The file `path` is a terminal, as `/dev/stdout` may be.
pub(crate) fn check_binary_file(path: &Path) -> Result<()> {
    // Only a device is opened: a pipe would wait for its reader.
    let is_device = path.metadata().is_ok_and(|found| is_device(&found));
    let open = || File::options().write(true).open(path);
    if is_device && open().is_ok_and(|file| file.is_terminal()) {
        return Err(is_terminal(&path.display().to_string()));
    }
    Ok(())
}

#[cfg(unix)]
fn is_device(found: &Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    found.file_type().is_char_device()
}

#[cfg(not(unix))]
fn is_device(_: &Metadata) -> bool {
    false
}

fn is_terminal(output: &str) -> Error {
    let error = Error::usage(format!(
        "{output} is a terminal, and images are binary data"
    ));
    error.note("redirect it, such as `> image.exr`, or pipe it into a program by `|`")
}

/// Writes all of `bytes`, or reports why they could not be made.
pub(crate) fn write_to_stdout(bytes: io::Result<Vec<u8>>) -> Result<()> {
    let bytes = bytes.map_err(failed)?;
    check()?;
    let mut stdout = io::stdout().lock();
    stdout
        .write_all(&bytes)
        .and_then(|()| stdout.flush())
        .map_err(failed)
}

/// Whether anybody reads standard output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reader {
    Present,
    /// The reader has closed its end of the pipe, as `head` does when it has enough.
    Gone,
}

/// Writes a report of one of several scenes. A reader that has gone is no error: nobody misses the
/// rest.
pub(crate) fn print(bytes: &[u8]) -> Result<Reader> {
    check()?;
    let mut stdout = io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(Reader::Gone),
        written => written.map(|()| Reader::Present).map_err(failed),
    }
}

/// Writes `value` as one line of JSON.
pub(crate) fn write_json_line(value: &impl Serialize) -> Result<()> {
    write_to_stdout(Ok(json::line(value)))
}

/// The error of a failed write to standard output.
pub(crate) fn failed(error: io::Error) -> Error {
    Error::writing(Path::new("standard output"), &error)
}

/// Detects a closed standard output before Rust's runtime hides it.
///
/// Before `main`, Rust opens `/dev/null` in place of a closed descriptor, so that no file gets its
/// number. Writing to it then succeeds, and a caller that redirects to `/dev/null` looks the same.
/// A constructor runs earlier and sees the descriptor as the caller left it.
#[cfg(unix)]
mod closed {
    use std::io;
    use std::sync::atomic::{AtomicBool, Ordering};

    static WAS_CLOSED: AtomicBool = AtomicBool::new(false);

    pub(super) fn was_closed() -> bool {
        WAS_CLOSED.load(Ordering::Relaxed)
    }

    pub(super) fn error() -> io::Error {
        rustix::io::Errno::BADF.into()
    }

    ctor::declarative::ctor! {
        /// Uses system calls only: `main` has not initialized the standard library yet.
        #[ctor(unsafe)]
        fn look() {
            let flags = rustix::io::fcntl_getfd(rustix::stdio::stdout());
            WAS_CLOSED.store(flags == Err(rustix::io::Errno::BADF), Ordering::Relaxed);
        }
    }
}

/// On other systems writing to a closed standard output fails.
#[cfg(not(unix))]
mod closed {
    use std::io;

    pub(super) fn was_closed() -> bool {
        false
    }

    pub(super) fn error() -> io::Error {
        io::ErrorKind::Unsupported.into()
    }
}
