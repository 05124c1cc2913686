//! Input that several threads read in pieces, in any order.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::ops::Range;
use std::path::Path;

/// The bytes that a sequential reader takes from a file at a time.
const READ_AT_ONCE: usize = 1 << 16;

/// An input of known size.
#[derive(Debug)]
pub(crate) enum Storage<'a> {
    /// In memory.
    Memory(&'a [u8]),
    /// A regular file, and its size when it was opened.
    File(File, u64),
}

impl Storage<'_> {
    /// Opens the file `path`. `None` if it is not a regular file, cannot be opened, or does not
    /// support positioned reads: then another reader reports why.
    pub(crate) fn open(path: &Path) -> Option<Storage<'static>> {
        let is_file = std::fs::metadata(path).is_ok_and(|metadata| metadata.is_file());
        if !cfg!(unix) || !is_file {
            return None;
        }
        let file = File::open(path).ok()?;
        let metadata = file.metadata().ok().filter(std::fs::Metadata::is_file)?;
        Some(Storage::File(file, metadata.len()))
    }

    /// The number of bytes.
    pub(crate) fn size(&self) -> u64 {
        match self {
            Storage::Memory(bytes) => bytes.len() as u64,
            Storage::File(_, size) => *size,
        }
    }

    /// All bytes in order.
    pub(crate) fn reader(&self) -> Box<dyn BufRead + Send + '_> {
        match self {
            Storage::Memory(bytes) => Box::new(*bytes),
            Storage::File(file, _) => Box::new(BufReader::with_capacity(READ_AT_ONCE, file)),
        }
    }

    /// The bytes `span`, which may be put into `buffer`: a reused one stays in the cache and needs
    /// no new memory.
    ///
    /// # Errors
    /// A read error, or bytes that end earlier.
    pub(crate) fn piece<'b>(
        &'b self,
        span: Range<u64>,
        buffer: &'b mut Vec<u8>,
    ) -> io::Result<&'b [u8]> {
        match self {
            Storage::Memory(bytes) => part(bytes, span),
            Storage::File(file, _) => {
                let size = span
                    .end
                    .checked_sub(span.start)
                    .and_then(|size| usize::try_from(size).ok());
                buffer.resize(size.ok_or(io::ErrorKind::InvalidInput)?, 0);
                read_at(file, buffer, span.start)?;
                Ok(buffer)
            }
        }
    }

    /// Like [`piece`](Storage::piece), but keeps the buffer.
    pub(crate) fn kept_piece(
        &self,
        span: Range<u64>,
        mut buffer: Vec<u8>,
    ) -> io::Result<Cow<'_, [u8]>> {
        match self {
            Storage::Memory(bytes) => part(bytes, span).map(Cow::Borrowed),
            Storage::File(..) => {
                self.piece(span, &mut buffer)?;
                Ok(Cow::Owned(buffer))
            }
        }
    }
}

/// The bytes `span` of `bytes`.
fn part(bytes: &[u8], span: Range<u64>) -> io::Result<&[u8]> {
    let start = usize::try_from(span.start).ok();
    let ends = start.zip(usize::try_from(span.end).ok());
    let part = ends.and_then(|(start, end)| bytes.get(start..end));
    part.ok_or_else(|| io::ErrorKind::UnexpectedEof.into())
}

/// Fills `buffer` from byte `offset` of `file` on.
#[cfg(unix)]
pub(super) fn read_at(file: &File, buffer: &mut [u8], offset: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, buffer, offset)
}

#[cfg(not(unix))]
pub(super) fn read_at(_: &File, _: &mut [u8], _: u64) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
