//! Executes the directives of scene files, and of the files that they include.

mod blocks;
mod coordinate_systems;
mod current_transform;
mod entities;
mod graphics_state;
mod includes;
mod materials;
mod name;
mod objects;
mod scene_builder;
mod transforms;

use super::inputs::Inputs;
use super::parser::{Directives, Next, Statement, Text, end_of_arguments, is_last};
use super::source_file::{SourceFile, SourceSpan};
use super::{AcceleratorParameters, LoadOptions, Scene};
use crate::error::Result;
use crate::file_id::InputFiles;
use crate::input::advise_beside;
use crate::progress::Progress;
use includes::{Includes, Tail};
use scene_builder::{Phase, SceneBuilder};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads one scene.
pub(super) struct Interpreter<'a> {
    path: PathBuf,
    progress: Progress<'a>,
    stops_at_world: bool,
    inputs: Inputs,
    includes: Includes,
    scene: SceneBuilder,
}

impl<'a> Interpreter<'a> {
    /// For the scene file `path`. `progress` counts bytes of scene files.
    pub(super) fn new(
        path: &Path,
        options: &LoadOptions,
        progress: Progress<'a>,
    ) -> Interpreter<'a> {
        Interpreter {
            path: path.to_path_buf(),
            progress,
            stops_at_world: false,
            inputs: Inputs::new(path, options.input_budget),
            includes: Includes::default(),
            scene: SceneBuilder::new(options),
        }
    }

    /// Reads the scene no further than `WorldBegin`: the file name of its film, and its
    /// accelerator.
    pub(super) fn read_options(mut self) -> Result<(Option<String>, AcceleratorParameters)> {
        self.stops_at_world = true;
        self.read_top_level()?;
        Ok(self.scene.into_names())
    }

    /// Executes the scene file.
    pub(super) fn read_top_level(&mut self) -> Result<()> {
        self.inputs.add_named(&self.path);
        let file = SourceFile::read_top_level(&self.path, self.inputs.budget())?;
        self.read(Arc::new(file), false).map(|_| ())
    }

    /// Executes `text` as if it were the scene file.
    pub(super) fn read_text(&mut self, text: Vec<u8>) -> Result<()> {
        self.inputs.budget().enter_bytes(text.len() as u64);
        let file = SourceFile::new(&self.path, text);
        self.read(Arc::new(file), false).map(|_| ())
    }

    /// The files that were read, or tried.
    pub(super) fn take_files(&mut self) -> InputFiles {
        self.inputs.take_files()
    }

    /// The scene that the directives have built.
    pub(super) fn finish(self) -> Result<Scene> {
        self.scene.finish(&self.path)
    }

    /// Executes a file and those that it includes. If arguments follow its `Include`, the file
    /// `is_continued`, and its last directive is returned instead of executed.
    fn read(&mut self, file: Arc<SourceFile>, is_continued: bool) -> Result<Option<Tail>> {
        self.includes.enter(file.path());
        let tail = self.read_directives(&file, is_continued)?;
        self.includes.leave();
        Ok(tail)
    }

    fn read_directives(
        &mut self,
        file: &Arc<SourceFile>,
        is_continued: bool,
    ) -> Result<Option<Tail>> {
        let mut directives = Directives::new(file);
        let mut seen = 0;
        loop {
            // Only a directive that is returned has to be found again.
            let start = if is_continued { directives.offset() } else { 0 };
            let directive = match directives.next() {
                None => return Ok(None),
                // Anything may follow the end of the world.
                Some(Err(_)) if self.scene.phase() == Phase::Ended => return Ok(None),
                // Perhaps the rest of it is in another file.
                Some(Err(_)) if is_continued && is_last(file.text(), start) => {
                    return Ok(Some(Tail::new(file, start)));
                }
                Some(directive) => directive?,
            };
            if !file.is_spliced() {
                self.progress.advance(directive.span.end - seen);
                seen = directive.span.end;
            }
            let keyword = SourceSpan::new(file, &directive.keyword);
            if self.scene.phase() == Phase::Ended {
                self.scene
                    .warn_of_the_rest(&keyword.beside(&directive.span));
                return Ok(None);
            }
            let includes = matches!(directive.statement, Statement::Include(_));
            if is_continued && !includes && directives.next_is() == Next::End {
                return Ok(Some(Tail::new(file, start)));
            }
            self.scene.count(&directive);
            self.scene.check_legal(&directive, &keyword)?;
            let mut tail = None;
            match &directive.statement {
                Statement::Include(name) => {
                    tail =
                        self.include_and_continue(name, &keyword, &mut directives, is_continued)?;
                }
                Statement::Import(name) => {
                    let was_in_object = self.scene.begin_import(&keyword);
                    self.include(name, &keyword, false)?;
                    self.scene.end_import(was_in_object);
                }
                _ => self.scene.execute(&directive, &keyword, &mut self.inputs)?,
            }
            if tail.is_some() || (self.stops_at_world && self.scene.phase() != Phase::Options) {
                return Ok(tail);
            }
        }
    }

    /// Reads an included file, and its last directive together with the arguments after the
    /// `Include` at `at`, which the `directives` have just passed.
    fn include_and_continue(
        &mut self,
        name: &Text,
        at: &SourceSpan,
        directives: &mut Directives,
        is_continued: bool,
    ) -> Result<Option<Tail>> {
        let goes_on = match directives.next_is() {
            Next::Argument => true,
            Next::End => is_continued,
            Next::Directive => false,
        };
        let Some(tail) = self.include(name, at, goes_on)? else {
            return Ok(None);
        };
        let start = directives.offset();
        let end = end_of_arguments(at.file().text(), start);
        directives.go_to(end);
        let is_continued = is_continued && directives.next_is() == Next::End;
        if is_continued && start == end {
            return Ok(Some(tail));
        }
        self.read_directives(&tail.with(at.file(), start..end), is_continued)
    }

    /// Reads the file `name` in place of the directive at `at`.
    fn include(
        &mut self,
        name: &Text,
        at: &SourceSpan,
        is_continued: bool,
    ) -> Result<Option<Tail>> {
        let named_at = at.beside(&name.span);
        if name.text.is_empty() {
            return Err(named_at.error("the name of the file is empty"));
        }
        let path = self.inputs.resolve(&name.path());
        if let Some(refusal) = self.includes.refusal(&path) {
            return Err(named_at.error(refusal));
        }
        self.inputs.add(&path);
        let included = SourceFile::read_included(&path, self.inputs.budget());
        // An error without a place is about this directive.
        let included = included.map_err(|error| error.or_at(|| named_at.location()));
        let read = included.and_then(|included| self.read(Arc::new(included), is_continued));
        read.map_err(|error| {
            let place = named_at.location();
            let error = advise_beside(&place.path, &name.path(), &path, error);
            error.note(format!("included from {place}"))
        })
    }
}
