//! Compressed files, told by their content and not by their name.

use std::borrow::Cow;
use std::io::Read;
use std::path::Path;

use super::Storage;
use super::budget::Budget;
use super::gzip_members::{MAGIC, Members};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::memory;

/// The memory that is taken on trust in the size that the file claims to have.
const TRUSTED_TIMES: usize = 16;

/// Whether `bytes` are compressed.
fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Whether the content of `storage` is compressed.
pub(crate) fn is_in(storage: &Storage) -> bool {
    let mut buffer = Vec::new();
    storage
        .piece(0..MAGIC.len() as u64, &mut buffer)
        .is_ok_and(recognises)
}

/// Compressed content, decompressed as it is read.
pub(crate) struct Stream<'a> {
    /// The content, which ends at the limit of what is believed.
    pub(crate) content: Box<dyn Read + Send + 'a>,
    /// The bytes that it may be trusted to have, as far as memory is concerned.
    pub(crate) trusted_size: usize,
}

/// What `read` makes of the content of the compressed `storage`: nothing where there is more of it than `budget` allows.
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
    let mut content = Members::new(storage.reader()).take(limit.saturating_add(1));
    let made = read(&mut Stream {
        content: Box::new(&mut content),
        trusted_size,
    })?;
    let length = limit.saturating_add(1) - content.limit();
    // What gives nothing is read again in another way, and charged then.
    (length <= limit).then(|| budget.charge_decompressed(length))?;
    Some(made)
}

/// What `parse` makes of the content of the file `path`, whose bytes are `bytes`.
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

/// The content of the file `path`, whose bytes are `bytes`, where they are compressed; else the bytes.
///
/// # Errors
/// Damaged data, and those that are more than `budget` allows.
pub(crate) fn content(path: &Path, bytes: Vec<u8>, budget: &Budget) -> Result<Vec<u8>> {
    if recognises(&bytes) {
        decompressed(path, &bytes, budget).map(Cow::into_owned)
    } else {
        Ok(bytes)
    }
}

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
    let read = Members::new(bytes)
        .take(limit.saturating_add(1))
        .read_to_end(&mut content);
    read.map_err(|error| damaged(path, &error))?;
    if content.len() as u64 > limit {
        return Err(bomb(path, bytes.len(), limit).note(budget.advice()));
    }
    budget.charge_decompressed(content.len() as u64);
    Ok(Cow::Owned(content))
}

/// What is believed of the last four bytes, the size of the content modulo 2^32, at the `end` of `size` bytes.
fn trusted_size(end: &[u8], size: usize) -> usize {
    let claimed = end
        .last_chunk()
        .map_or(0, |size| u32::from_le_bytes(*size) as usize);
    claimed.min(size.saturating_mul(TRUSTED_TIMES))
}

fn damaged(path: &Path, error: &std::io::Error) -> Error {
    let message = format!("the gzip data are damaged or cut off: {error}");
    let location = SourceLocation::file(path);
    Error::bad_input(
        Diagnostic::new(message)
            .at(location)
            .note("test the file with `gzip -t`"),
    )
}

fn bomb(path: &Path, size: usize, limit: u64) -> Error {
    let message = format!(
        "{size} bytes of gzip data decompress to more than {limit} bytes, which the compressed files of a scene have left"
    );
    Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(path)))
}
