//! Files that are read in place of a directive: `Include` and `Import`.

use super::blocks::Block;
use super::builder::Builder;
use super::parser::{Span, Text};
use super::source::{Place, Source};
use crate::error::Result;
use crate::input::advise_beside;
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

/// The last directive of an included file, which goes on behind the `Include`: it begins at `start` of `source`.
pub(super) struct Tail {
    source: Rc<Source>,
    start: usize,
}

impl Tail {
    pub(super) fn new(source: &Rc<Source>, start: usize) -> Tail {
        Tail {
            source: Rc::clone(source),
            start,
        }
    }

    /// The directive with the `arguments` that it has in another file.
    pub(super) fn with(&self, source: &Rc<Source>, arguments: Span) -> Rc<Source> {
        Rc::new(Source::spliced(&self.source, self.start, source, arguments))
    }
}

impl Builder<'_> {
    /// Reads the file `name` in place of a directive. Where `is_continued`, its last directive is not obeyed but
    /// handed back, since more of it is to come.
    pub(super) fn include(
        &mut self,
        name: &Text,
        source: &Rc<Source>,
        is_continued: bool,
    ) -> Result<Option<Tail>> {
        if name.text.is_empty() {
            return Err(source.error(&name.span, "the name of the file is empty"));
        }
        let path = self.directory.join(name.path());
        if let Some(refusal) = self.includes.refusal(&path) {
            return Err(source.error(&name.span, refusal));
        }
        self.files.add(&path);
        // What says nothing of its own place is about this directive.
        let included = Source::read_included(&path, &self.budget);
        let included = included.map_err(|error| error.or_at(|| source.at(&name.span)));
        let read = included.and_then(|included| self.read(Rc::new(included), is_continued));
        read.map_err(|error| {
            let place = source.at(&name.span);
            let error = advise_beside(&place.path, &name.path(), &path, error);
            error.note(format!("included from {place}"))
        })
    }

    /// As `Include`, but what the file does to the graphics state ends with it, and so do the coordinate systems that
    /// it names; objects and materials stay.
    pub(super) fn import(
        &mut self,
        name: &Text,
        keyword: &Span,
        source: &Rc<Source>,
    ) -> Result<()> {
        if !self.in_world {
            let error = source
                .error(keyword, "Import outside the world")
                .note("expected after WorldBegin");
            return Err(error.note("Include reads a file anywhere"));
        }
        let is_in_object = self.objects.open.is_some();
        self.state.begin(Block::Import, Place::new(source, keyword));
        self.include(name, source, false)?;
        self.close_blocks();
        if !is_in_object {
            self.define_object();
        }
        self.state.end_import();
        Ok(())
    }
}
