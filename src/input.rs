//! Reading input files whole.

use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use std::fs::{self, FileType};
use std::io::{self, Read};
use std::path::Path;

/// The bytes of standard input.
///
/// # Errors
/// Where reading fails.
pub(crate) fn read_stdin() -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let read = io::stdin().read_to_end(&mut bytes);
    read.map(|_| bytes).map_err(|error| Error::reading(Path::new("-"), &error))
}

/// The bytes of a file.
///
/// # Errors
/// A file that is missing, unreadable, or a device, some of which never end.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    refuse_device(path).and_then(|()| fs::read(path)).map_err(|error| match error.kind() {
        io::ErrorKind::Unsupported => {
            let diagnostic = Diagnostic::new("this is a device, not a file").at(SourceLocation::file(path));
            Error::new(ErrorKind::MissingInput, diagnostic)
        }
        _ => Error::reading(path, &error),
    })
}

fn refuse_device(path: &Path) -> io::Result<()> {
    if is_device(fs::metadata(path)?.file_type()) { Err(io::ErrorKind::Unsupported.into()) } else { Ok(()) }
}

#[cfg(unix)]
fn is_device(file_type: FileType) -> bool {
    use std::os::unix::fs::FileTypeExt;
    file_type.is_char_device() || file_type.is_block_device()
}

#[cfg(not(unix))]
fn is_device(_: FileType) -> bool {
    false
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn devices_that_never_end_are_refused() {
        let error = read(Path::new("/dev/zero")).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::MissingInput);
        assert_eq!(error.to_string(), "/dev/zero: this is a device, not a file");
    }
}
