//! Why an image cannot be read.

use crate::error::{Diagnostic, Error, ErrorKind, SourceLocation};
use std::path::Path;

/// An image that cannot be read.
#[derive(Debug, Clone)]
pub(crate) struct ImageRefusal {
    pub(crate) diagnostic: Box<Diagnostic>,
    /// Set if the scene cannot be read, either: memory, or a limit, does not allow it.
    pub(crate) fatal: Option<ErrorKind>,
}

impl From<Error> for ImageRefusal {
    fn from(error: Error) -> ImageRefusal {
        let kind = error.kind();
        ImageRefusal {
            diagnostic: Box::new(error.diagnostic().clone()),
            fatal: (kind == ErrorKind::TryAgain).then_some(kind),
        }
    }
}

impl ImageRefusal {
    /// An image with this fault.
    pub(super) fn new(message: impl Into<String>) -> ImageRefusal {
        ImageRefusal {
            diagnostic: Box::new(Diagnostic::new(message)),
            fatal: None,
        }
    }

    /// An image that exceeds a limit of the scene.
    pub(super) fn fatal(error: Error) -> ImageRefusal {
        ImageRefusal {
            fatal: Some(error.kind()),
            ..error.into()
        }
    }

    /// The same with a note.
    pub(super) fn note(self, note: &str) -> ImageRefusal {
        ImageRefusal {
            diagnostic: Box::new(self.diagnostic.note(note)),
            ..self
        }
    }

    /// The same about the file `path`, unless it says where the fault is.
    pub(super) fn or_in(self, path: &Path) -> ImageRefusal {
        let diagnostic = match self.diagnostic.location {
            Some(_) => self.diagnostic,
            None => Box::new(self.diagnostic.at(SourceLocation::file(path))),
        };
        ImageRefusal { diagnostic, ..self }
    }
}
