//! Recognizes by their first bytes files that cannot be scene text.

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::scene::source_file::SourceFile;

/// Text has no NUL byte; a binary file nearly always has one among this many.
const BYTES_TO_JUDGE_BY: usize = 1024;

/// The text of a scene file without its byte order mark.
///
/// # Errors
/// A file that is compressed twice, UTF-16, binary, or a Git LFS pointer.
pub(super) fn check(file: &SourceFile) -> Result<&[u8]> {
    let bytes = file.text();
    let head = &bytes[..bytes.len().min(BYTES_TO_JUDGE_BY)];
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
        [0xef, 0xbb, 0xbf, ..] if !head.contains(&0) => return Ok(&bytes[3..]),
        _ if head.starts_with(b"version https://git-lfs.github.com/spec") => (
            "this is a Git LFS pointer: the scene itself has not been fetched",
            "`git lfs pull` fetches it",
        ),
        _ if head.contains(&0) => ("this is a binary file", "expected the text of a PBRT scene"),
        _ => return Ok(bytes),
    };
    let diagnostic = Diagnostic::new(message).at(SourceLocation::file(file.path()));
    Err(Error::bad_input(diagnostic.note(note)))
}
