//! Files that are read in place of a directive: `Include` and `Import`.

use super::builder::Builder;
use super::graphics_state::Block;
use super::parser::{Span, Text};
use super::source::{Place, Source};
use crate::error::Result;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Files that include each other, at most.
const MAX_DEPTH: usize = 64;

/// The files of a scene that have been read so far.
#[derive(Debug, Default)]
pub(super) struct Includes {
    /// Those being read, each included by the one before.
    open: Vec<PathBuf>,
}

impl Includes {
    /// The file `path` is read from now on.
    pub(super) fn enter(&mut self, path: &Path) {
        self.open.push(identity(path));
    }

    /// The file entered last has been read.
    pub(super) fn leave(&mut self) {
        self.open.pop();
    }

    /// Why the file `path` must not be read now.
    fn refusal(&self, path: &Path) -> Option<String> {
        if self.open.contains(&identity(path)) {
            Some(format!("{} includes itself", path.display()))
        } else if self.open.len() >= MAX_DEPTH {
            Some(format!("more than {MAX_DEPTH} files include each other"))
        } else {
            None
        }
    }
}

/// One name for each file, as far as the system can tell.
fn identity(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}

impl Builder<'_> {
    pub(super) fn include(&mut self, name: &Text, source: &Rc<Source>) -> Result<()> {
        if name.text.is_empty() {
            return Err(source.error(&name.span, "the name of the file is empty"));
        }
        let path = self.directory.join(&*name.text);
        if let Some(refusal) = self.includes.refusal(&path) {
            return Err(source.error(&name.span, refusal));
        }
        // What says nothing of its own place is about this directive.
        let included =
            Source::read_included(&path, &self.budget).map_err(|error| error.or_at(|| source.at(&name.span)));
        let read = included.and_then(|included| self.read(Rc::new(included)));
        read.map_err(|error| error.note(format!("included from {}", source.at(&name.span))))
    }

    /// As `Include`, but what the file does to the graphics state ends with it; names that it gives stay.
    pub(super) fn import(&mut self, name: &Text, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        if !self.in_world {
            let error = source.error(keyword, "Import outside the world").note("expected after WorldBegin");
            return Err(error.note("Include reads a file anywhere"));
        }
        self.state.begin(Block::Import, Place::new(source, keyword));
        self.include(name, source)?;
        self.check_closed_but_for(Some(Block::Import))?;
        self.end(Block::Import, keyword, source)
    }
}
