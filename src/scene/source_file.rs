//! Pieces of the text of a scene file: where they stand in the file, in lines and columns.

use super::place::Place;
use crate::error::{
    Diagnostic, Error, SHOWN_BYTES, SourceLocation, TextPosition, is_line_end, shown_from,
};
use std::ops::Range;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// Bytes of a text, counted from 0.
pub type Span = Range<usize>;

/// The text of a file or a piece of it, or the text of one directive that several files share.
#[derive(Debug)]
pub struct SourceFile {
    path: Arc<Path>,
    /// Where the piece begins in the text of the file.
    offset: usize,
    begin: TextPosition,
    text: Vec<u8>,
    /// Whether the text of the file ends with this piece.
    is_last: bool,
    /// Empty unless the text comes from several files; else in order, the first at the start.
    parts: Vec<Part>,
    /// The bytes of the piece whose lines were counted last, and where they end.
    counted: Mutex<(usize, TextPosition)>,
}

/// A part of a spliced text: it reaches from `start` to the next part.
#[derive(Debug, Clone)]
struct Part {
    start: usize,
    file: Arc<SourceFile>,
    /// Where the part begins in its file.
    offset: usize,
}

impl SourceFile {
    /// A file called `path` that contains `text`.
    pub fn new(path: &Path, text: Vec<u8>) -> SourceFile {
        SourceFile::piece(&Arc::from(path), 0, TextPosition::default(), text, true)
    }

    /// The piece `text` of the file `path`: it begins at byte `offset`, which is at `begin`.
    pub(super) fn piece(
        path: &Arc<Path>,
        offset: usize,
        begin: TextPosition,
        text: Vec<u8>,
        is_last: bool,
    ) -> SourceFile {
        SourceFile {
            path: Arc::clone(path),
            offset,
            begin,
            text,
            is_last,
            parts: Vec::new(),
            counted: Mutex::new((0, begin)),
        }
    }

    /// The text of `first` from `start` on, followed by the `span` of `second`. Spans of it count
    /// from its own start.
    pub(super) fn spliced(
        first: &Arc<SourceFile>,
        start: usize,
        second: &Arc<SourceFile>,
        span: Span,
    ) -> SourceFile {
        let mut text = first.from(start).to_vec();
        let mut parts = first.parts_from(start..first.end());
        // The end of a file ends a word and a comment.
        text.push(b'\n');
        let moved = |part: Part| Part {
            start: part.start + text.len(),
            ..part
        };
        parts.extend(second.parts_from(span.clone()).into_iter().map(moved));
        text.extend_from_slice(second.slice(&span));
        SourceFile {
            parts,
            ..SourceFile::piece(&second.path, 0, TextPosition::default(), text, true)
        }
    }

    /// The parts of the text in `span`, as if it began there.
    fn parts_from(&self, span: Span) -> Vec<Part> {
        let start = span.start;
        if self.parts.is_empty() {
            return vec![Part {
                start: 0,
                file: Arc::new(self.excerpt(&span)),
                offset: start,
            }];
        }
        let first = self.parts.partition_point(|part| part.start <= start) - 1;
        let moved = |part: &Part| Part {
            start: part.start.saturating_sub(start),
            offset: part.offset + start.saturating_sub(part.start),
            ..part.clone()
        };
        self.parts[first..].iter().map(moved).collect()
    }

    /// A copy of `span` with all that messages show around it.
    pub(super) fn excerpt(&self, span: &Span) -> SourceFile {
        let [start, end] = [span.start, span.end].map(|at| self.index(at));
        let from = shown_from(&self.text, start);
        let after = &self.text[end..self.text.len().min(end + SHOWN_BYTES)];
        let to = end + after.iter().position(is_line_end).unwrap_or(after.len());
        let text = self.text[from..to].to_vec();
        let begin = self.position(span.start).before(&self.text[from..start]);
        SourceFile::piece(&self.path, self.offset + from, begin, text, false)
    }

    /// A copy of `span` that does not hold the whole piece `file`. A spliced text is small.
    pub(super) fn kept(file: &Arc<SourceFile>, span: &Span) -> Arc<SourceFile> {
        match file.is_spliced() {
            true => Arc::clone(file),
            false => Arc::new(file.excerpt(span)),
        }
    }

    /// Takes the text out of the piece.
    pub(super) fn into_text(self) -> Vec<u8> {
        self.text
    }

    /// The bytes of memory that the text takes.
    #[cfg(test)]
    pub(super) fn capacity(&self) -> usize {
        self.text.capacity()
    }

    /// The file as the user named it, or as a scene reached it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn shared_path(&self) -> &Arc<Path> {
        &self.path
    }

    /// Where the piece begins in the text of the file.
    pub(super) fn start(&self) -> usize {
        self.offset
    }

    /// Where the piece ends in the text of the file.
    pub(super) fn end(&self) -> usize {
        self.offset + self.text.len()
    }

    /// Whether the text of the file ends with this piece.
    pub(super) fn is_last(&self) -> bool {
        self.is_last
    }

    /// The bytes of the piece from `start` on.
    pub(super) fn from(&self, start: usize) -> &[u8] {
        &self.text[self.index(start)..]
    }

    /// The bytes of `span`.
    pub(super) fn slice(&self, span: &Span) -> &[u8] {
        &self.text[self.index(span.start)..self.index(span.end)]
    }

    /// The index in the piece of byte `at` of the text.
    fn index(&self, at: usize) -> usize {
        at.saturating_sub(self.offset).min(self.text.len())
    }

    /// Whether the text comes from several files.
    pub(super) fn is_spliced(&self) -> bool {
        !self.parts.is_empty()
    }

    /// The line and column of byte `at` of the text, which must not be within a character or CR LF.
    /// Bytes that were passed are not counted again.
    pub(super) fn position(&self, at: usize) -> TextPosition {
        let index = self.index(at);
        let mut counted = self.counted.lock().unwrap_or_else(PoisonError::into_inner);
        if counted.0 > index {
            *counted = (0, self.begin);
        }
        let (passed, mut position) = *counted;
        position.pass(&self.text[passed..index]);
        *counted = (index, position);
        position
    }

    /// The part that `at` is in, and the place in its file.
    fn part_of(&self, at: usize) -> Option<(&Part, usize)> {
        let after = self.parts.partition_point(|part| part.start <= at);
        let part = &self.parts[after.checked_sub(1)?];
        Some((part, at - part.start + part.offset))
    }

    /// Whether the whole file is empty: it has no lines.
    fn is_of_empty_file(&self) -> bool {
        self.offset == 0 && self.text.is_empty()
    }

    /// File, line and column of `span`. Of an empty file, only the file is named.
    pub(super) fn at(&self, span: &Span) -> SourceLocation {
        if let Some((part, start)) = self.part_of(span.start) {
            // What follows the part is in another file.
            let mut starts = self.parts.iter().map(|part| part.start);
            let next = starts.find(|next| *next > span.start).unwrap_or(usize::MAX);
            let length = span.end.min(next).saturating_sub(span.start);
            return part.file.at(&(start..start + length));
        }
        if self.is_of_empty_file() {
            return SourceLocation::file(&self.path);
        }
        let local = self.index(span.start)..self.index(span.end);
        SourceLocation::in_piece(&self.path, &self.text, local, self.position(span.start))
    }

    /// File, line and column of `at`, without the line.
    pub(super) fn place(&self, at: usize) -> Place {
        if let Some((part, at)) = self.part_of(at) {
            return part.file.place(at);
        }
        Place {
            path: Arc::clone(&self.path),
            position: (!self.is_of_empty_file()).then(|| self.position(at)),
        }
    }

    /// An error at `span`.
    pub(super) fn error(&self, span: &Span, message: impl Into<String>) -> Error {
        Error::bad_input(Diagnostic::new(message).at(self.at(span)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spliced_text_knows_the_lines_of_its_files() {
        let file = |path: &str, text: &str| Arc::new(SourceFile::new(Path::new(path), text.into()));
        let inner = file("inner", "A\nShape \"a\"");
        let outer = file("outer", "Include \"inner\"\n \"b\" 1\nEnd");
        let spliced = Arc::new(SourceFile::spliced(&inner, 2, &outer, 15..22));
        assert_eq!(spliced.text, b"Shape \"a\"\n\n \"b\" 1");
        assert_eq!(spliced.at(&(6..9)).to_string(), "inner:2:7");
        assert_eq!(spliced.at(&(12..15)).to_string(), "outer:2:2");
        let last = file("last", "  2\n3");
        let twice = SourceFile::spliced(&spliced, 6, &last, 2..5);
        let at = |start: usize| twice.at(&(start..start + 1)).to_string();
        assert_eq!(
            [at(0), at(6), at(12), at(14)],
            ["inner:2:7", "outer:2:2", "last:1:3", "last:2:1"]
        );
    }
}
