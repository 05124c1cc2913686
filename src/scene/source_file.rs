//! The text of a scene file, and spans of it.

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{self, Budget, gzip};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Bytes of a text, counted from 0.
pub type Span = Range<usize>;

/// The whole text of a file, or of one directive that several files share.
#[derive(Debug)]
pub struct SourceFile {
    path: PathBuf,
    text: Vec<u8>,
    /// Empty unless the text comes from several files; else in order, the first at the start.
    parts: Vec<Part>,
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
        SourceFile {
            path: path.to_path_buf(),
            text,
            parts: Vec::new(),
        }
    }

    /// Reads the scene that the user named, `-` for standard input; within a scene `-` is a file
    /// like any other. Gzip data is decompressed; spans count in the decompressed text.
    pub(super) fn read_top_level(path: &Path, budget: &Budget) -> Result<SourceFile> {
        let is_stdin = path == Path::new("-");
        let is_known = !is_stdin && budget.enter(path);
        let bytes = if is_stdin {
            input::read_stdin()?
        } else {
            input::read(path)?
        };
        if !is_known {
            // A pipe has no size before it is read.
            budget.enter_stream(path, bytes.len() as u64);
        }
        SourceFile::decompressed(path, bytes, is_known, budget)
    }

    /// Reads a regular file that a scene includes, compressed or not.
    pub(super) fn read_included(path: &Path, budget: &Budget) -> Result<SourceFile> {
        budget.charge_file()?;
        input::refuse_special(path)?;
        let is_known = budget.enter(path);
        SourceFile::decompressed(path, input::read(path)?, is_known, budget)
    }

    fn decompressed(
        path: &Path,
        bytes: Vec<u8>,
        is_known: bool,
        budget: &Budget,
    ) -> Result<SourceFile> {
        let text = gzip::content(path, bytes, budget)?;
        budget.charge_text(text.len() as u64, is_known)?;
        Ok(SourceFile::new(path, text))
    }

    /// The text of `first` from `start` on, followed by the `span` of `second`.
    pub(super) fn spliced(
        first: &Arc<SourceFile>,
        start: usize,
        second: &Arc<SourceFile>,
        span: Span,
    ) -> SourceFile {
        let mut text = first.text[start..].to_vec();
        let mut parts = first.parts_from(start);
        // The end of a file ends a word and a comment.
        text.push(b'\n');
        let moved = |part: Part| Part {
            start: part.start + text.len(),
            ..part
        };
        parts.extend(second.parts_from(span.start).into_iter().map(moved));
        text.extend_from_slice(&second.text[span]);
        SourceFile {
            path: second.path.clone(),
            text,
            parts,
        }
    }

    /// The parts of the text from `start` on, as if it began there.
    fn parts_from(self: &Arc<SourceFile>, start: usize) -> Vec<Part> {
        if self.parts.is_empty() {
            return vec![Part {
                start: 0,
                file: Arc::clone(self),
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

    /// The file as the user named it, or as a scene reached it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The bytes of the text.
    pub fn text(&self) -> &[u8] {
        &self.text
    }

    /// Whether the text comes from several files.
    pub(super) fn is_spliced(&self) -> bool {
        !self.parts.is_empty()
    }

    /// File, line and column of `span`. An empty file has no lines: only the file is named.
    pub(super) fn at(&self, span: &Span) -> SourceLocation {
        let after = self.parts.partition_point(|part| part.start <= span.start);
        let Some(part) = after.checked_sub(1).map(|index| &self.parts[index]) else {
            return match self.text.is_empty() {
                true => SourceLocation::file(&self.path),
                false => SourceLocation::text(&self.path, &self.text, span.clone()),
            };
        };
        // What follows the part is in another file.
        let end = self
            .parts
            .get(after)
            .map_or(span.end, |next| span.end.min(next.start));
        let in_file = |at: usize| at - part.start + part.offset;
        SourceLocation::text(
            &part.file.path,
            &part.file.text,
            in_file(span.start)..in_file(end),
        )
    }

    /// An error at `span`.
    pub(super) fn error(&self, span: &Span, message: impl Into<String>) -> Error {
        Error::bad_input(Diagnostic::new(message).at(self.at(span)))
    }
}

/// A span that remembers its file. Its line and column are only counted when they are shown.
#[derive(Debug, Clone)]
pub struct SourceSpan {
    file: Arc<SourceFile>,
    span: Span,
}

impl SourceSpan {
    pub(super) fn new(file: &Arc<SourceFile>, span: &Span) -> SourceSpan {
        SourceSpan {
            file: Arc::clone(file),
            span: span.clone(),
        }
    }

    /// Another span of the same file.
    pub(super) fn beside(&self, span: &Span) -> SourceSpan {
        SourceSpan::new(&self.file, span)
    }

    pub(super) fn file(&self) -> &Arc<SourceFile> {
        &self.file
    }

    /// File, line and column.
    pub fn location(&self) -> SourceLocation {
        self.file.at(&self.span)
    }

    /// An error at this place.
    pub(super) fn error(&self, message: impl Into<String>) -> Error {
        self.file.error(&self.span, message)
    }

    /// A warning or note about this place.
    pub(super) fn diagnostic(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(message).at(self.location())
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
