//! A file, line and column without the text of the line.

use crate::error::TextPosition;
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

impl fmt::Display for Place {
    /// `path:line:column`, counted from 1.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.display();
        match self.position {
            None => write!(f, "{path}"),
            Some(TextPosition { line, column }) => {
                write!(f, "{path}:{}:{}", line + 1, column + 1)
            }
        }
    }
}
