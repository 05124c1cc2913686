//! The text of a scene file, and places in it.

use super::parser::Span;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{self, gzip};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// One file, whole.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) path: PathBuf,
    pub(super) text: Vec<u8>,
}

impl Source {
    /// Reads a file, compressed with gzip or not; places in it count in what is decompressed.
    pub(super) fn read(path: &Path) -> Result<Source> {
        Source::of(path, input::read(path)?)
    }

    /// Reads the scene that the user named, `-` for standard input; within a scene `-` is a file like any other.
    pub(super) fn read_top_level(path: &Path) -> Result<Source> {
        if path != Path::new("-") {
            return Source::read(path);
        }
        Source::of(path, input::read_stdin()?)
    }

    fn of(path: &Path, bytes: Vec<u8>) -> Result<Source> {
        Ok(Source { path: path.to_path_buf(), text: gzip::content(path, bytes)? })
    }

    /// The place of `span`.
    pub(super) fn at(&self, span: &Span) -> SourceLocation {
        SourceLocation::text(&self.path, &self.text, span.clone())
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
        Place { source: Rc::clone(source), span: span.clone() }
    }

    /// The scene is wrong here.
    pub(super) fn error(&self, message: impl Into<String>) -> Error {
        self.source.error(&self.span, message)
    }
}
