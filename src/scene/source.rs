//! The text of a scene file, and places in it.

use super::parser::Span;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// One file, whole.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) path: PathBuf,
    pub(super) text: Vec<u8>,
}

impl Source {
    /// Reads a file, or standard input where `path` is `-`.
    pub(super) fn read(path: &Path) -> Result<Source> {
        Ok(Source { path: path.to_path_buf(), text: input::read(path)? })
    }

    /// The place of `span`.
    pub(super) fn at(&self, span: &Span) -> SourceLocation {
        SourceLocation::text(&self.path, &self.text, span.clone())
    }

    /// Number `place`, from 0, of the array of numbers at `array`.
    pub(super) fn number_in(&self, array: &Span, place: usize) -> Span {
        let blank = |byte: &u8| byte.is_ascii_whitespace() || matches!(byte, b',' | b'[' | b']');
        let mut position = array.start;
        for remaining in (0..=place).rev() {
            position += self.text[position..array.end].iter().take_while(|byte| blank(byte)).count();
            while self.text[position..array.end].starts_with(b"#") {
                let comment = &self.text[position..array.end];
                position += comment.iter().take_while(|byte| !matches!(byte, b'\n' | b'\r')).count();
                position += self.text[position..array.end].iter().take_while(|byte| blank(byte)).count();
            }
            let token = self.text[position..array.end].iter();
            let length = token.take_while(|byte| !blank(byte) && **byte != b'#').count();
            if remaining == 0 {
                return position..position + length;
            }
            position += length;
        }
        array.clone()
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
