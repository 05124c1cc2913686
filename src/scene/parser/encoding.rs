//! Files that cannot be scene text, told by their first bytes.

use super::source::Source;
use crate::error::{Error, Result};

/// A text has no NUL, a binary file nearly always has one among so many bytes.
const BYTES_TO_JUDGE_BY: usize = 1024;

/// The text of a scene file without its byte order mark.
pub(super) fn text<'a>(source: &Source<'a>) -> Result<&'a [u8]> {
    let bytes = source.bytes;
    let head = &bytes[..bytes.len().min(BYTES_TO_JUDGE_BY)];
    match head {
        [0x1f, 0x8b, ..] => Err(compressed(source)),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Err(utf16(source)),
        [0, second, ..] if second.is_ascii_graphic() => Err(utf16(source)),
        [first, 0, ..] if first.is_ascii_graphic() => Err(utf16(source)),
        [0xef, 0xbb, 0xbf, ..] if !head.contains(&0) => Ok(&bytes[3..]),
        _ if head.starts_with(b"version https://git-lfs.github.com/spec") => Err(pointer(source)),
        _ if head.contains(&0) => Err(binary(source)),
        _ => Ok(bytes),
    }
}

fn compressed(source: &Source) -> Error {
    source
        .file_error("this is gzip data, compressed twice")
        .note("expected the text of a PBRT scene, compressed once or not at all")
}

fn utf16(source: &Source) -> Error {
    source
        .file_error("this file is UTF-16 text")
        .note("expected ASCII or UTF-8: save it as UTF-8")
}

fn pointer(source: &Source) -> Error {
    source
        .file_error("this is a Git LFS pointer: the scene itself has not been fetched")
        .note("`git lfs pull` fetches it")
}

fn binary(source: &Source) -> Error {
    source
        .file_error("this is a binary file")
        .note("expected the text of a PBRT scene")
}
