//! Reading input files: whole, or in pieces.

pub(crate) mod gzip;
mod gzip_members;
mod storage;

pub(crate) use storage::Storage;

use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use std::fs::{self, File, FileType};
use std::io::{self, Read};
use std::path::Path;

use rayon::prelude::*;

/// Bytes that a thread reads at a time: files of no more are read by one.
const PIECE: usize = 1 << 20;

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
    refuse_device(path).and_then(|()| read_whole(path)).map_err(|error| match error.kind() {
        io::ErrorKind::Unsupported => {
            let diagnostic = Diagnostic::new("this is a device, not a file").at(SourceLocation::file(path));
            Error::new(ErrorKind::MissingInput, diagnostic)
        }
        _ => Error::reading(path, &error),
    })
}

fn read_whole(path: &Path) -> io::Result<Vec<u8>> {
    match Storage::open(path) {
        Some(Storage::File(file, size)) if size > PIECE as u64 => read_pieces(&file, size).or_else(|_| fs::read(path)),
        _ => fs::read(path),
    }
}

/// Reads the first `size` bytes: copies and page faults are shared by the threads.
fn read_pieces(file: &File, size: u64) -> io::Result<Vec<u8>> {
    let size = usize::try_from(size).map_err(|_| io::ErrorKind::OutOfMemory)?;
    // Zeroed memory costs nothing before it is used, but is refused by ending the program: so ask politely first.
    Vec::<u8>::new().try_reserve_exact(size)?;
    let mut bytes = vec![0; size];
    let pieces = bytes.par_chunks_mut(PIECE).enumerate();
    pieces.try_for_each(|(number, piece)| storage::read_at(file, piece, (number * PIECE) as u64))?;
    Ok(bytes)
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
    fn large_files_are_read_in_pieces() {
        let bytes: Vec<u8> = (0..3 * PIECE + 7).map(|at| (at ^ at >> 8 ^ at >> 16) as u8).collect();
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("large");
        fs::write(&path, &bytes).expect("room for it");
        assert!(read(&path).as_ref() == Ok(&bytes));
        let storage = Storage::open(&path).expect("a regular file");
        let mut buffer = Vec::new();
        for span in [0..5, 1000..70_000, 3 * PIECE as u64..bytes.len() as u64, 9..9] {
            let expected = &bytes[span.start as usize..span.end as usize];
            assert_eq!(storage.piece(span.clone(), &mut buffer).expect("bytes"), expected);
            assert_eq!(Storage::Memory(&bytes).piece(span, &mut buffer).expect("bytes"), expected);
        }
        let beyond = bytes.len() as u64 - 1..bytes.len() as u64 + 1;
        assert!(storage.piece(beyond.clone(), &mut buffer).is_err());
        assert!(Storage::Memory(&bytes).piece(beyond, &mut buffer).is_err());
    }

    #[test]
    fn devices_that_never_end_are_refused() {
        let error = read(Path::new("/dev/zero")).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::MissingInput);
        assert_eq!(error.to_string(), "/dev/zero: this is a device, not a file");
    }
}
