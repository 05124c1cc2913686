//! The text being parsed: spans of it and errors in it.

use std::path::{Path, PathBuf};

use super::statement::Span;
use crate::error::{Diagnostic, Error, Position, SourceLocation};

/// A scene file's text. What is left to parse is always a suffix of it, so its length says where it begins.
#[derive(Debug, Clone)]
pub(super) struct Source<'a> {
    path: PathBuf,
    pub(super) bytes: &'a [u8],
    /// Where the text comes from, where that is not one file.
    pieces: Vec<Piece<'a>>,
}

/// A part of a text that is put together from several files: a directive may go on behind an `Include`.
#[derive(Debug, Clone, Copy)]
pub(in crate::scene) struct Piece<'a> {
    /// Where it begins in the text.
    pub(in crate::scene) start: usize,
    pub(in crate::scene) path: &'a Path,
    /// The whole file.
    pub(in crate::scene) file: &'a [u8],
    /// Where it begins in the file.
    pub(in crate::scene) offset: usize,
}

/// The place of `span` in the file of the piece that it begins in; `pieces` are in order, from the start of the text.
pub(in crate::scene) fn locate(pieces: &[Piece], span: &Span) -> Option<SourceLocation> {
    let after = pieces.partition_point(|piece| piece.start <= span.start);
    let piece = &pieces[after.checked_sub(1)?];
    // Beyond the end of the piece there is a file that the span is not in.
    let end = pieces
        .get(after)
        .map_or(span.end, |next| span.end.min(next.start));
    let moved = |at: usize| at - piece.start + piece.offset;
    Some(SourceLocation::text(
        piece.path,
        piece.file,
        moved(span.start)..moved(end),
    ))
}

/// What a nom parser of the grammar makes of its input.
pub(super) type Parsed<'a, T> = nom::IResult<&'a [u8], T, Fault>;

/// Why a parser of the grammar did not succeed.
#[derive(Debug)]
pub(super) enum Fault {
    /// The text is not of this form; it may be of another.
    Mismatch,
    /// The text is wrong.
    Wrong(Error),
}

impl<I> nom::error::ParseError<I> for Fault {
    fn from_error_kind(_: I, _: nom::error::ErrorKind) -> Fault {
        Fault::Mismatch
    }

    fn append(_: I, _: nom::error::ErrorKind, other: Fault) -> Fault {
        other
    }
}

/// An error in the text is not mended by another alternative.
impl From<Error> for nom::Err<Fault> {
    fn from(error: Error) -> nom::Err<Fault> {
        nom::Err::Failure(Fault::Wrong(error))
    }
}

/// The failure of a parser whose input is wrong.
pub(super) fn wrong<'a, T>(error: Error) -> Parsed<'a, T> {
    Err(error.into())
}

/// The refusal of a parser whose input is of another form.
pub(super) fn mismatch<'a, T>() -> Parsed<'a, T> {
    Err(nom::Err::Error(Fault::Mismatch))
}

impl<'a> Source<'a> {
    pub(super) fn new(path: &Path, bytes: &'a [u8]) -> Source<'a> {
        Source {
            path: path.to_path_buf(),
            bytes,
            pieces: Vec::new(),
        }
    }

    pub(super) fn of_pieces(pieces: Vec<Piece<'a>>, bytes: &'a [u8]) -> Source<'a> {
        let path = pieces
            .last()
            .map_or(PathBuf::new(), |piece| piece.path.to_path_buf());
        Source {
            path,
            bytes,
            pieces,
        }
    }

    fn location(&self, span: Span) -> SourceLocation {
        locate(&self.pieces, &span)
            .unwrap_or_else(|| SourceLocation::text(&self.path, self.bytes, span))
    }

    /// The bytes from where `from` begins to where `to` begins; both are suffixes of the text.
    pub(super) fn span(&self, from: &[u8], to: &[u8]) -> Span {
        self.bytes.len() - from.len()..self.bytes.len() - to.len()
    }

    /// The first `length` bytes of the suffix `rest`.
    pub(super) fn first(&self, rest: &[u8], length: usize) -> Span {
        let start = self.bytes.len() - rest.len();
        start..start + length
    }

    /// The error `message` about `span`, with advice still to be added.
    pub(super) fn error(&self, span: Span, message: impl Into<String>) -> Error {
        Error::bad_input(Diagnostic::new(message).at(self.location(span)))
    }

    /// An error about the file as a whole.
    pub(super) fn file_error(&self, message: impl Into<String>) -> Error {
        Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(&self.path)))
    }

    /// Where the suffix `rest` begins, in words.
    pub(super) fn place(&self, rest: &[u8]) -> String {
        match self.location(self.first(rest, 0)).position {
            Position::Text { line, column, .. } => format!("line {line}, column {column}"),
            _ => String::from("an unknown line"),
        }
    }
}
