//! The stack of files that are read in place of an `Include` or `Import`.

use crate::scene::source_file::{SourceFile, Span};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The most files that may include each other.
const MAX_DEPTH: usize = 64;

/// The files that are being read, each included by the one before it.
#[derive(Debug, Default)]
pub(super) struct Includes {
    open: Vec<PathBuf>,
}

impl Includes {
    /// Starts the file `path`.
    pub(super) fn enter(&mut self, path: &Path) {
        self.open.push(identity(path));
    }

    /// Ends the file that was entered last.
    pub(super) fn leave(&mut self) {
        self.open.pop();
    }

    /// Why the file `path` must not be included now.
    pub(super) fn refusal(&self, path: &Path) -> Option<String> {
        if self.open.contains(&identity(path)) {
            Some(format!("{} includes itself", path.display()))
        } else if self.open.len() >= MAX_DEPTH {
            Some(format!("more than {MAX_DEPTH} files include each other"))
        } else {
            None
        }
    }
}

/// One name for each file, as far as the system knows.
fn identity(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}

/// The last directive of an included file, whose arguments continue behind the `Include`.
pub(super) struct Tail {
    file: Arc<SourceFile>,
    start: usize,
}

impl Tail {
    /// The directive at `start` of `file`.
    pub(super) fn new(file: &Arc<SourceFile>, start: usize) -> Tail {
        Tail {
            file: Arc::clone(file),
            start,
        }
    }

    /// The directive followed by the `arguments` in the file `rest`.
    pub(super) fn with(&self, rest: &Arc<SourceFile>, arguments: Span) -> Arc<SourceFile> {
        Arc::new(SourceFile::spliced(&self.file, self.start, rest, arguments))
    }
}
