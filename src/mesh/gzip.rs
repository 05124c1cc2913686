//! Compressed meshes, told by their content and not by their name.

use std::borrow::Cow;
use std::io::Read;
use std::path::Path;

use flate2::bufread::MultiGzDecoder;

use crate::error::{Diagnostic, Error, Result, SourceLocation};

const MAGIC: &[u8] = b"\x1f\x8b";

/// A mesh does not shrink to less than this part of its size, unless it is made to fill the memory.
const MOST_TIMES: u64 = 256;
/// Small files may shrink more than that.
const MOST_BYTES: u64 = 64 << 20;
/// The memory that is taken on trust in the size that the file claims to have.
const TRUSTED_TIMES: usize = 16;

/// Whether `bytes` are compressed.
fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// What `parse` makes of the content of the file `path`, whose bytes are `bytes`.
pub(super) fn parsed<T>(path: &Path, bytes: &[u8], parse: impl FnOnce(&[u8]) -> Result<T>) -> Result<T> {
    parse(&decompressed(path, bytes)?).map_err(|error| match recognises(bytes) {
        true => error.note("places count in the decompressed file"),
        false => error,
    })
}

fn decompressed<'a>(path: &Path, bytes: &'a [u8]) -> Result<Cow<'a, [u8]>> {
    if !recognises(bytes) {
        return Ok(Cow::Borrowed(bytes));
    }
    let limit = bytes.len() as u64 * MOST_TIMES + MOST_BYTES;
    let mut content = Vec::with_capacity(claimed_size(bytes).min(bytes.len() * TRUSTED_TIMES));
    let read = MultiGzDecoder::new(bytes).take(limit + 1).read_to_end(&mut content);
    read.map_err(|error| damaged(path, &error))?;
    if content.len() as u64 > limit {
        return Err(bomb(path, bytes.len(), limit));
    }
    Ok(Cow::Owned(content))
}

/// The last four bytes are the size of the content, modulo 2^32.
fn claimed_size(bytes: &[u8]) -> usize {
    bytes.last_chunk().map_or(0, |size| u32::from_le_bytes(*size) as usize)
}

fn damaged(path: &Path, error: &std::io::Error) -> Error {
    let message = format!("the gzip data are damaged or cut off: {error}");
    let location = SourceLocation::file(path);
    Error::bad_input(Diagnostic::new(message).at(location).note("test the file with `gzip -t`"))
}

fn bomb(path: &Path, size: usize, limit: u64) -> Error {
    let message = format!("{size} bytes of gzip data decompress to more than {limit} bytes");
    let location = SourceLocation::file(path);
    Error::bad_input(Diagnostic::new(message).at(location).note("if this is meant, decompress the file first"))
}
