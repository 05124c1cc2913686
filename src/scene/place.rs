//! A file, line and column without the text of the line.

use crate::error::{Position, SourceLocation, TextPosition};
use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// A place in a file. It keeps nothing of the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    pub(super) path: Arc<Path>,
    /// `None` for the whole file.
    pub(super) position: Option<TextPosition>,
}

impl Place {
    /// The same place for a message, which shows no text.
    pub fn location(&self) -> SourceLocation {
        let character = |TextPosition { line, column }| Position::Character {
            line: line + 1,
            column: column + 1,
        };
        SourceLocation {
            path: self.path.to_path_buf(),
            position: self.position.map_or(Position::File, character),
        }
    }
}

impl fmt::Display for Place {
    /// `path:line:column`, counted from 1.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.location().fmt(f)
    }
}
