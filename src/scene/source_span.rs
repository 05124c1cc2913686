//! Spans that remember their file, for messages.

use super::place::Place;
use super::source_file::{SourceFile, Span};
use crate::error::{Diagnostic, Error, SourceLocation};
use std::sync::Arc;

/// A span that remembers its file. Its line and column are only counted when they are shown. It
/// holds the piece of the text that it is in; a kept one does not.
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

    /// The same span with a copy of what messages show around it, instead of the piece of the text.
    pub(super) fn kept(&self) -> SourceSpan {
        SourceSpan {
            file: SourceFile::kept(&self.file, &self.span),
            span: self.span.clone(),
        }
    }

    pub(super) fn file(&self) -> &Arc<SourceFile> {
        &self.file
    }

    pub(super) fn span(&self) -> &Span {
        &self.span
    }

    /// Where it begins.
    pub(super) fn start(&self) -> usize {
        self.span.start
    }

    /// File, line and column, with the line.
    pub fn location(&self) -> SourceLocation {
        self.file.at(&self.span)
    }

    /// File, line and column.
    pub(super) fn place(&self) -> Place {
        self.file.place(self.span.start)
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
