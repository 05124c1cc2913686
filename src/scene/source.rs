//! The text of a scene file, and places in it.

use super::parser::Span;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{self, Budget, gzip};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// One file, whole.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) path: PathBuf,
    pub(super) text: Vec<u8>,
}

impl Source {
    /// Reads the scene that the user named, `-` for standard input; within a scene `-` is a file like any other.
    /// It may be compressed with gzip; places in it count in what is decompressed.
    pub(super) fn read_top_level(path: &Path, budget: &Budget) -> Result<Source> {
        let is_stdin = path == Path::new("-");
        let is_known = !is_stdin && budget.enter(path);
        let bytes = if is_stdin { input::read_stdin()? } else { input::read(path)? };
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
        Ok(Source { path: path.to_path_buf(), text })
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
