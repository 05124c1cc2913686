//! The page of a report: `index.html` in a folder, a name that other pages have, too.

use crate::bench::is_report;
use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The name of the page.
pub(super) const NAME: &str = "index.html";

/// Bytes to read: the title of the page is among them.
const HEAD: u64 = 1024;

/// # Errors
/// `directory` has a page that feimos did not write: the user named the folder, not the page.
pub(super) fn check(directory: &Path) -> Result<()> {
    let path = directory.join(NAME);
    if !path.is_file() {
        return Ok(());
    }
    let mut head = Vec::new();
    let read = File::open(&path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    read.map_err(|error| Error::reading(&path, &error))?;
    if is_report(&String::from_utf8_lossy(&head)) {
        return Ok(());
    }
    let diagnostic = Diagnostic::new("exists already, and is not a report by feimos")
        .at(SourceLocation::file(&path))
        .note("move it away, or give --report another folder");
    Err(Error::new(ErrorKind::Output, diagnostic))
}
