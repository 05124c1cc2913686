//! Recognizes by their first bytes files that cannot be scene text.

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{Signature, without_utf8_mark};
use std::path::Path;

/// Text has no NUL byte; a binary file nearly always has one among this many.
pub(in crate::scene) const BYTES_TO_JUDGE_BY: usize = 1024;

/// Checks the first bytes of the scene file `path`, which are up to [`BYTES_TO_JUDGE_BY`] long.
/// Returns the length of its byte order mark.
///
/// # Errors
/// A file that is compressed twice, UTF-16, binary, a Git LFS pointer, or of another format.
pub(in crate::scene) fn check(path: &Path, head: &[u8]) -> Result<usize> {
    let head = &head[..head.len().min(BYTES_TO_JUDGE_BY)];
    let (message, note) = match Signature::of(path, head) {
        Some(Signature::UTF_16) => (
            "this file is UTF-16 text".to_owned(),
            "expected ASCII or UTF-8: save it as UTF-8".to_owned(),
        ),
        Some(Signature::LFS_POINTER) => (
            "this is a Git LFS pointer: the scene itself has not been fetched".to_owned(),
            "`git lfs pull` fetches it".to_owned(),
        ),
        Some(signature) => {
            let once = "expected the text of a PBRT scene, compressed once or not at all";
            let advice = signature.advice();
            (
                format!("this is {}", signature.name),
                advice.unwrap_or(once.to_owned()),
            )
        }
        None if head.contains(&0) => (
            "this is a binary file".to_owned(),
            "expected the text of a PBRT scene".to_owned(),
        ),
        None => return Ok(head.len() - without_utf8_mark(head).len()),
    };
    let diagnostic = Diagnostic::new(message).at(SourceLocation::file(path));
    Err(Error::bad_input(diagnostic.note(note)))
}
