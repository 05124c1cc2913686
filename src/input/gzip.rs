//! Decompresses gzip files, which are recognized by their content.

use std::borrow::Cow;
use std::io::{self, Read};
use std::path::Path;

use super::Storage;
use super::budget::Budget;
use super::gzip_members::{MAGIC, Members};
use crate::error::{Diagnostic, Error, Result, SourceLocation, grouped};
use crate::memory;

/// The most memory that is reserved because the file claims that size.
const TRUSTED_TIMES: usize = 16;

/// Whether `bytes` are gzip data.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Whether `storage` contains gzip data.
pub(crate) fn is_in(storage: &Storage) -> bool {
    let mut buffer = Vec::new();
    storage
        .piece(0..MAGIC.len() as u64, &mut buffer)
        .is_ok_and(recognises)
}

/// A stream of decompressed content.
pub(crate) struct Stream<'a> {
    /// The content, which ends at the limit that the budget allows.
    pub(crate) content: Box<dyn Read + Send + 'a>,
    /// The size that may be reserved in memory for it.
    pub(crate) trusted_size: usize,
}

/// Content whose reading may be cancelled.
struct Cancellable<'a, R> {
    content: R,
    budget: &'a Budget<'a>,
}

impl<R: Read> Read for Cancellable<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.budget.check_cancelled();
        self.content.read(buffer)
    }
}

/// Decompresses `storage` for `read`. `None` if the content is larger than `budget` allows.
pub(crate) fn stream<T>(
    storage: &Storage,
    budget: &Budget,
    read: impl FnOnce(&mut Stream) -> Option<T>,
) -> Option<T> {
    let mut buffer = Vec::new();
    let size = storage.size();
    let end = storage
        .piece(size.saturating_sub(4)..size, &mut buffer)
        .ok()?;
    let trusted_size = trusted_size(end, usize::try_from(size).ok()?);
    let limit = budget.decompressed_left();
    let content = Members::new(storage.reader());
    let mut content = Cancellable { content, budget }.take(limit.saturating_add(1));
    let made = read(&mut Stream {
        content: Box::new(&mut content),
        trusted_size,
    })?;
    let length = limit.saturating_add(1) - content.limit();
    // Without a result the file is read again in another way, and charged then.
    (length <= limit).then(|| budget.charge_decompressed(length))?;
    Some(made)
}

/// Parses the content of the file `path`, whose `bytes` may be compressed.
pub(crate) fn parsed<T>(
    path: &Path,
    bytes: &[u8],
    budget: &Budget,
    parse: impl FnOnce(&[u8]) -> Result<T>,
) -> Result<T> {
    parse(&decompressed(path, bytes, budget)?).map_err(|error| match recognises(bytes) {
        true => error.note("places count in the decompressed file"),
        false => error,
    })
}

/// The content of the file `path`, whose `bytes` may be compressed.
///
/// # Errors
/// Damaged data, and more data than `budget` allows.
fn decompressed<'a>(path: &Path, bytes: &'a [u8], budget: &Budget) -> Result<Cow<'a, [u8]>> {
    if !recognises(bytes) {
        return Ok(Cow::Borrowed(bytes));
    }
    let limit = budget.decompressed_left();
    let trusted =
        trusted_size(bytes, bytes.len()).min(usize::try_from(limit).unwrap_or(usize::MAX));
    let too_large = || "these gzip data are too large for this machine's memory".to_owned();
    memory::check(trusted as u64, too_large)
        .map_err(|error| error.or_at(|| SourceLocation::file(path)))?;
    let mut content = Vec::with_capacity(trusted);
    let members = Members::new(bytes);
    let read = Cancellable {
        content: members,
        budget,
    }
    .take(limit.saturating_add(1))
    .read_to_end(&mut content);
    read.map_err(|error| damaged(path, &error))?;
    if content.len() as u64 > limit {
        return Err(bomb(path, bytes.len() as u64, limit).note(budget.advice()));
    }
    budget.charge_decompressed(content.len() as u64);
    Ok(Cow::Owned(content))
}

/// The size that may be reserved, from the last four bytes, which are the size of the content
/// modulo 2^32, at the `end` of `size` bytes.
fn trusted_size(end: &[u8], size: usize) -> usize {
    let claimed = end
        .last_chunk()
        .map_or(0, |size| u32::from_le_bytes(*size) as usize);
    claimed.min(size.saturating_mul(TRUSTED_TIMES))
}

pub(super) fn damaged(path: &Path, error: &std::io::Error) -> Error {
    let message = format!("the gzip data are damaged or cut off: {error}");
    let location = SourceLocation::file(path);
    Error::bad_input(
        Diagnostic::new(message)
            .at(location)
            .note("test the file with `gzip -t`"),
    )
}

pub(super) fn bomb(path: &Path, size: u64, limit: u64) -> Error {
    let message = format!(
        "{} bytes of gzip data decompress to more than {} bytes, \
         which the compressed files of a scene have left",
        grouped(size),
        grouped(limit)
    );
    Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(path)))
}
