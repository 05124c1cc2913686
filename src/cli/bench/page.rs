//! The page of a report, which stands in a folder under a name that other pages have, too.

use feimos::bench::is_report;
use feimos::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The page in the directory of a report.
pub(super) const NAME: &str = "index.html";

/// Bytes that are looked at: what tells is in the head of the page.
const HEAD: u64 = 1024;

/// # Errors
/// A page in `directory` that is not of feimos: the user has named the folder, and not the page.
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
    let diagnostic = Diagnostic::new("exists already, and is no report of feimos")
        .at(SourceLocation::file(&path));
    Err(Error::new(
        ErrorKind::Output,
        diagnostic.note("move it away, or give --report another folder"),
    ))
}
