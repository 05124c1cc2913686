//! Executes the directives of scene files, and of the files that they include.

mod blocks;
mod coordinate_systems;
mod current_transform;
mod entities;
mod graphics_state;
mod includes;
mod materials;
mod objects;
mod scene_builder;
#[cfg(test)]
mod tests;
mod transforms;
mod unfit_matrices;

use super::inputs::Inputs;
use super::parser::{Directives, Next, Statement, Step, Text, end_of_arguments, is_last};
use super::scene_text::{SceneText, WINDOW};
use super::source_file::SourceFile;
use super::source_span::SourceSpan;
use super::{LoadOptions, Scene};
use crate::error::Result;
use crate::file_id::InputFiles;
use crate::input::{TextStream, advise_beside};
use crate::progress::Progress;
use includes::{Includes, Tail};
use scene_builder::{Phase, SceneBuilder};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How much of a file has been executed.
enum Read {
    /// All of it, but for its last directive, which may continue in another file.
    All(Option<Tail>),
    /// What is certain before the next piece is read.
    Part,
}

/// Reads one scene.
pub(super) struct Interpreter<'a> {
    path: PathBuf,
    progress: Progress<'a>,
    stops_at_world: bool,
    /// The bytes of a scene file that are in memory at a time.
    window: usize,
    inputs: Inputs<'a>,
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
            window: WINDOW,
            inputs: Inputs::new(path, options.input_budget, progress),
            includes: Includes::default(),
            scene: SceneBuilder::new(options),
        }
    }

    /// The file name of the film. Reads the scene no further than `WorldBegin`.
    pub(super) fn read_film_filename(mut self) -> Result<Option<String>> {
        self.stops_at_world = true;
        self.read_top_level()?;
        Ok(self.scene.into_film_filename())
    }

    /// Executes the scene file.
    pub(super) fn read_top_level(&mut self) -> Result<()> {
        self.inputs.add_named(&self.path);
        let stream = TextStream::open_named(&self.path, self.inputs.budget())?;
        self.read(stream, None, false).map(|_| ())
    }

    /// Executes `text` as if it were the scene file.
    pub(super) fn read_text(&mut self, text: Vec<u8>) -> Result<()> {
        let stream = TextStream::of_memory(&self.path, text, self.inputs.budget());
        self.read(stream, None, false).map(|_| ())
    }

    /// The files that were read, or tried.
    pub(super) fn take_files(&mut self) -> InputFiles {
        self.inputs.take_files()
    }

    /// The scene that the directives have built.
    pub(super) fn finish(self) -> Result<Scene> {
        self.scene.finish(&self.path)
    }

    /// Executes a file, which a scene names at `named_at`, and those that it includes. If arguments
    /// follow its `Include`, the file `is_continued`, and its last directive is returned instead of
    /// executed.
    fn read(
        &mut self,
        stream: TextStream,
        named_at: Option<SourceSpan>,
        is_continued: bool,
    ) -> Result<Option<Tail>> {
        self.includes.enter(stream.path());
        let mut text = SceneText::new(stream, self.window, named_at, self.inputs.budget())?;
        let read = self.read_pieces(&mut text, is_continued);
        let budget = self.inputs.budget();
        let tail = match read {
            // Nothing in damaged data is worth an error.
            Err(error) => return Err(text.damage(budget).unwrap_or(error)),
            Ok(tail) => tail,
        };
        if !self.stops_at_world {
            text.finish(budget)?;
        }
        self.includes.leave();
        Ok(tail)
    }

    fn read_pieces(&mut self, text: &mut SceneText, is_continued: bool) -> Result<Option<Tail>> {
        let mut seen = 0;
        loop {
            let piece = Arc::clone(text.piece());
            let mut directives = text.directives(&piece);
            let read = self.read_directives(&piece, &mut directives, &mut seen, is_continued)?;
            if let Read::All(tail) = read {
                return Ok(tail);
            }
            let position = directives.into_position();
            self.scene.settle();
            drop(piece);
            text.advance(position, self.inputs.budget())?;
        }
    }

    /// Executes the `directives` of `file`, or of a piece of it. The first bytes of the file, of
    /// number `seen`, have been reported as progress.
    fn read_directives(
        &mut self,
        file: &Arc<SourceFile>,
        directives: &mut Directives,
        seen: &mut usize,
        is_continued: bool,
    ) -> Result<Read> {
        loop {
            // Only a directive that is returned has to be found again.
            let start = if is_continued { directives.offset() } else { 0 };
            let directive = match directives.step() {
                Step::End => return Ok(Read::All(None)),
                Step::NeedsMore => return Ok(Read::Part),
                // Anything may follow the end of the world.
                Step::Error(_) if self.scene.phase() == Phase::Ended => {
                    return Ok(Read::All(None));
                }
                // Perhaps the rest of it is in another file.
                Step::Error(_) if is_continued && is_last(file, start) => {
                    return Ok(Read::All(Some(Tail::new(file, start))));
                }
                Step::Error(error) => return Err(error),
                Step::Directive(directive) => directive,
            };
            if !file.is_spliced() {
                self.progress.advance(directive.span.end - *seen);
                *seen = directive.span.end;
            }
            let keyword = SourceSpan::new(file, &directive.keyword);
            if self.scene.phase() == Phase::Ended {
                self.scene
                    .warn_of_the_rest(&keyword.beside(&directive.span));
                return Ok(Read::All(None));
            }
            let includes = matches!(directive.statement, Statement::Include(_));
            if is_continued && !includes && directives.next_is() == Next::End {
                return Ok(Read::All(Some(Tail::new(file, start))));
            }
            self.scene.count(&directive);
            self.scene.check_legal(&directive, &keyword)?;
            let mut tail = None;
            match &directive.statement {
                Statement::Include(name) => {
                    tail = self.include_and_continue(name, &keyword, directives, is_continued)?;
                }
                Statement::Import(name) => {
                    let was_in_object = self.scene.begin_import(&keyword);
                    self.include(name, &keyword, false)?;
                    self.scene.end_import(was_in_object);
                }
                _ => self.scene.execute(&directive, &keyword, &mut self.inputs)?,
            }
            if tail.is_some() || (self.stops_at_world && self.scene.phase() != Phase::Options) {
                return Ok(Read::All(tail));
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
        let end = end_of_arguments(at.file(), start);
        directives.go_to(end);
        let is_continued = is_continued && directives.next_is() == Next::End;
        if is_continued && start == end {
            return Ok(Some(tail));
        }
        let whole = tail.with(at.file(), start..end);
        let mut directives = Directives::new(&whole);
        match self.read_directives(&whole, &mut directives, &mut 0, is_continued)? {
            Read::All(tail) => Ok(tail),
            Read::Part => Ok(None),
        }
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
        let included = TextStream::open_included(&path, self.inputs.budget());
        // An error without a place is about this directive.
        let included = included.map_err(|error| error.or_at(|| named_at.location()));
        let read = included.and_then(|text| self.read(text, Some(named_at.clone()), is_continued));
        read.map_err(|error| {
            let place = named_at.location();
            let error = advise_beside(&place.path, &name.path(), &path, error);
            error.note(format!("included from {place}"))
        })
    }
}
