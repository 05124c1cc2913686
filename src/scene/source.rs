//! The text of a scene file, and places in it.

use super::parser::{Directives, Piece, Span, locate};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{self, Budget, gzip};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// One file, whole; or a directive that is spread over several.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) path: PathBuf,
    pub(super) text: Vec<u8>,
    /// Where the text comes from, where that is not one file.
    parts: Vec<Part>,
}

/// A part of a text that is put together, as [`Piece`].
#[derive(Debug, Clone)]
struct Part {
    start: usize,
    file: Rc<Source>,
    offset: usize,
}

impl Part {
    fn piece(&self) -> Piece<'_> {
        Piece {
            start: self.start,
            path: &self.file.path,
            file: &self.file.text,
            offset: self.offset,
        }
    }
}

impl Source {
    /// Reads the scene that the user named, `-` for standard input; within a scene `-` is a file like any other.
    /// It may be compressed with gzip; places in it count in what is decompressed.
    pub(super) fn read_top_level(path: &Path, budget: &Budget) -> Result<Source> {
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
        Source::of(path, bytes, is_known, budget)
    }

    /// Reads a file that a scene includes, compressed or not. It has to be a regular one.
    pub(super) fn read_included(path: &Path, budget: &Budget) -> Result<Source> {
        budget.charge_file()?;
        input::refuse_special(path)?;
        let is_known = budget.enter(path);
        Source::of(path, input::read(path)?, is_known, budget)
    }

    fn of(path: &Path, bytes: Vec<u8>, is_known: bool, budget: &Budget) -> Result<Source> {
        let text = gzip::content(path, bytes, budget)?;
        budget.charge_text(text.len() as u64, is_known)?;
        Ok(Source::new(path, text))
    }

    /// The text of the file `path`.
    pub(super) fn new(path: &Path, text: Vec<u8>) -> Source {
        Source {
            path: path.to_path_buf(),
            text,
            parts: Vec::new(),
        }
    }

    /// What `first` has from `start` on, and behind it the bytes `span` of `second`.
    pub(super) fn spliced(
        first: &Rc<Source>,
        start: usize,
        second: &Rc<Source>,
        span: Span,
    ) -> Source {
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
        Source {
            path: second.path.clone(),
            text,
            parts,
        }
    }

    /// The parts of the text from `start` on, as if it began there.
    fn parts_from(self: &Rc<Source>, start: usize) -> Vec<Part> {
        if self.parts.is_empty() {
            return vec![Part {
                start: 0,
                file: Rc::clone(self),
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

    fn pieces(&self) -> Vec<Piece<'_>> {
        self.parts.iter().map(Part::piece).collect()
    }

    /// The directives in the text.
    pub(super) fn directives(&self) -> Directives<'_> {
        match self.is_spliced() {
            true => Directives::of_pieces(self.pieces(), &self.text),
            false => Directives::new(&self.path, &self.text),
        }
    }

    /// Whether the text comes from several files.
    pub(super) fn is_spliced(&self) -> bool {
        !self.parts.is_empty()
    }

    /// The place of `span`.
    pub(super) fn at(&self, span: &Span) -> SourceLocation {
        let in_part = locate(&self.pieces(), span);
        in_part.unwrap_or_else(|| SourceLocation::text(&self.path, &self.text, span.clone()))
    }

    /// The scene is wrong at `span`.
    pub(super) fn error(&self, span: &Span, message: impl Into<String>) -> Error {
        Error::bad_input(Diagnostic::new(message).at(self.at(span)))
    }
}

/// A place that may have to be shown later. Finding its line takes a walk through the file, which most never need.
#[derive(Clone)]
pub(super) struct Place {
    source: Rc<Source>,
    span: Span,
}

impl Place {
    pub(super) fn new(source: &Rc<Source>, span: &Span) -> Place {
        Place {
            source: Rc::clone(source),
            span: span.clone(),
        }
    }

    /// The place as messages show it.
    pub(super) fn location(&self) -> SourceLocation {
        self.source.at(&self.span)
    }

    /// The scene is wrong here.
    pub(super) fn error(&self, message: impl Into<String>) -> Error {
        self.source.error(&self.span, message)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_in_a_spliced_text_are_those_of_its_files() {
        let file = |path: &str, text: &str| Rc::new(Source::new(Path::new(path), text.into()));
        let inner = file("inner", "A\nShape \"a\"");
        let outer = file("outer", "Include \"inner\"\n \"b\" 1\nEnd");
        let spliced = Rc::new(Source::spliced(&inner, 2, &outer, 15..22));
        assert_eq!(spliced.text, b"Shape \"a\"\n\n \"b\" 1");
        assert_eq!(spliced.at(&(6..9)).to_string(), "inner:2:7");
        assert_eq!(spliced.at(&(12..15)).to_string(), "outer:2:2");
        let last = file("last", "  2\n3");
        let twice = Source::spliced(&spliced, 6, &last, 2..5);
        let at = |start: usize| twice.at(&(start..start + 1)).to_string();
        assert_eq!(
            [at(0), at(6), at(12), at(14)],
            ["inner:2:7", "outer:2:2", "last:1:3", "last:2:1"]
        );
    }
}
