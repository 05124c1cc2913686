//! Recognizes by their first bytes files that cannot be scene text.

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use std::path::Path;

/// Text has no NUL byte; a binary file nearly always has one among this many.
pub(in crate::scene) const BYTES_TO_JUDGE_BY: usize = 1024;

/// Checks the first bytes of the scene file `path`, which are up to [`BYTES_TO_JUDGE_BY`] long.
/// Returns the length of its byte order mark.
///
/// # Errors
/// A file that is compressed twice, UTF-16, binary, or a Git LFS pointer.
pub(in crate::scene) fn check(path: &Path, head: &[u8]) -> Result<usize> {
    let head = &head[..head.len().min(BYTES_TO_JUDGE_BY)];
    let utf16 = (
        "this file is UTF-16 text",
        "expected ASCII or UTF-8: save it as UTF-8",
    );
    let (message, note) = match head {
        [0x1f, 0x8b, ..] => (
            "this is gzip data, compressed twice",
            "expected the text of a PBRT scene, compressed once or not at all",
        ),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => utf16,
        [0, second, ..] if second.is_ascii_graphic() => utf16,
        [first, 0, ..] if first.is_ascii_graphic() => utf16,
        [0xef, 0xbb, 0xbf, ..] if !head.contains(&0) => return Ok(3),
        _ if head.starts_with(b"version https://git-lfs.github.com/spec") => (
            "this is a Git LFS pointer: the scene itself has not been fetched",
            "`git lfs pull` fetches it",
        ),
        _ if head.contains(&0) => ("this is a binary file", "expected the text of a PBRT scene"),
        _ => return Ok(0),
    };
    let diagnostic = Diagnostic::new(message).at(SourceLocation::file(path));
    Err(Error::bad_input(diagnostic.note(note)))
}
