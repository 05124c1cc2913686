//! Reads input files, whole or in pieces.

mod budget;
mod budget_factor;
pub(crate) mod gzip;
mod gzip_members;
mod inflated;
mod irregular;
mod missing;
mod signature;
mod storage;
mod text_stream;

pub(crate) use budget::{Budget, pairs_of};
pub use budget_factor::BudgetFactor;
pub(crate) use irregular::refuse_special;
pub(crate) use missing::advise_beside;
pub(crate) use signature::{Kind, Signature, without_utf8_mark};
pub(crate) use storage::Storage;
pub(crate) use text_stream::TextStream;

use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation, grouped};
use crate::memory;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use rayon::prelude::*;

/// The bytes that a thread reads at a time; smaller files are read by one thread.
const PIECE: usize = 1 << 20;

/// Whether the caller has a pool of several threads. Asking for their number alone would start one.
fn has_threads() -> bool {
    rayon::current_thread_index().is_some() && rayon::current_num_threads() > 1
}

/// Reads an input of unknown size, which may never end.
fn read_stream(path: &Path, stream: &mut impl Read) -> Result<Vec<u8>> {
    let limit = memory::available().map_or(u64::MAX - 1, |available| available / PART_OF_MEMORY);
    let mut bytes = Vec::new();
    let read = stream.take(limit + 1).read_to_end(&mut bytes);
    read.map_err(|error| Error::reading(path, &error))?;
    if bytes.len() as u64 > limit {
        let message = format!(
            "the input has more than {} bytes, a quarter of the memory that is to be had",
            grouped(limit)
        );
        let diagnostic = Diagnostic::new(message).at(SourceLocation::file(path));
        return Err(Error::new(
            ErrorKind::TryAgain,
            diagnostic.note("does it never end? else put it into a file"),
        ));
    }
    Ok(bytes)
}

/// The part of the available memory that an input of unknown size may take.
const PART_OF_MEMORY: u64 = 4;

/// Reads a file that the command line names, which may be a pipe.
///
/// # Errors
/// A file that is missing, unreadable, a folder, or a device, some of which never end.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    let metadata =
        fs::metadata(path).map_err(|error| missing::advise(path, Error::reading(path, &error)))?;
    let file_type = metadata.file_type();
    irregular::refuse_named(path, file_type)?;
    if file_type.is_file() {
        let too_large = || "this file is too large for this machine's memory".to_owned();
        memory::check(metadata.len(), too_large)
            .map_err(|error| error.or_at(|| SourceLocation::file(path)))?;
        return read_whole(path).map_err(|error| Error::reading(path, &error));
    }
    let mut pipe = File::open(path).map_err(|error| Error::reading(path, &error))?;
    read_stream(path, &mut pipe)
}

fn read_whole(path: &Path) -> io::Result<Vec<u8>> {
    match Storage::open(path) {
        Some(Storage::File(file, size)) if size > PIECE as u64 => {
            read_pieces(&file, size).or_else(|_| fs::read(path))
        }
        _ => fs::read(path),
    }
}

/// Reads the first `size` bytes. The threads share copies and page faults.
fn read_pieces(file: &File, size: u64) -> io::Result<Vec<u8>> {
    let size = usize::try_from(size).map_err(|_| io::ErrorKind::OutOfMemory)?;
    // Zeroed memory costs nothing before it is used, but running out of it ends the program: so try
    // to reserve it first.
    Vec::<u8>::new().try_reserve_exact(size)?;
    let mut bytes = vec![0; size];
    let pieces = bytes.par_chunks_mut(PIECE).enumerate();
    pieces
        .try_for_each(|(number, piece)| storage::read_at(file, piece, (number * PIECE) as u64))?;
    Ok(bytes)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn large_files_are_read_in_pieces() {
        let bytes: Vec<u8> = (0..3 * PIECE + 7)
            .map(|at| (at ^ at >> 8 ^ at >> 16) as u8)
            .collect();
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("large");
        fs::write(&path, &bytes).expect("room for it");
        assert!(read(&path).as_ref() == Ok(&bytes));
        let storage = Storage::open(&path).expect("a regular file");
        let mut buffer = Vec::new();
        for span in [
            0..5,
            1000..70_000,
            3 * PIECE as u64..bytes.len() as u64,
            9..9,
        ] {
            let expected = &bytes[span.start as usize..span.end as usize];
            assert_eq!(
                storage.piece(span.clone(), &mut buffer).expect("bytes"),
                expected
            );
            let kept = storage.kept_piece(span.clone(), vec![7]);
            assert_eq!(kept.expect("bytes"), expected);
            assert_eq!(
                Storage::Memory(&bytes)
                    .piece(span, &mut buffer)
                    .expect("bytes"),
                expected
            );
        }
        let beyond = bytes.len() as u64 - 1..bytes.len() as u64 + 1;
        assert!(storage.piece(beyond.clone(), &mut buffer).is_err());
        assert!(Storage::Memory(&bytes).piece(beyond, &mut buffer).is_err());
    }

    #[test]
    fn streams_are_read_up_to_a_part_of_the_memory() {
        let path = Path::new("-");
        assert_eq!(
            read_stream(path, &mut &b"all of it"[..]),
            Ok(b"all of it".to_vec())
        );
    }

    #[test]
    fn devices_that_never_end_are_refused() {
        let error = read(Path::new("/dev/zero")).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::MissingInput);
        assert_eq!(error.to_string(), "/dev/zero: this is a device, not a file");
    }
}
