//! Executes the directives of scene files.

mod blocks;
mod entities;
mod graphics_state;
mod includes;
mod materials;
mod name;
mod objects;
mod transforms;

use super::census::{Census, MAX_LISTED};
use super::inputs::Inputs;
use super::locations::Locations;
use super::parameters::Parameters;
use super::parser::{
    Directive, Directives, Entity, KEYWORDS, Legal, Next, Statement, Text, end_of_arguments,
    is_last,
};
use super::shapes::{self, ShapeTarget};
use super::source_file::{SourceFile, SourceSpan};
use super::warnings::Warnings;
use super::{AcceleratorParameters, LoadOptions, Scene};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::file_id::InputFiles;
use crate::input::advise_beside;
use crate::progress::Progress;
use blocks::Block;
use entities::Entities;
use graphics_state::GraphicsState;
use includes::{Includes, Tail};
use materials::{Material, Materials};
use objects::Objects;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A scene under construction.
pub(super) struct Interpreter<'a> {
    path: PathBuf,
    options: LoadOptions,
    progress: Progress<'a>,
    stops_at_world: bool,
    phase: Phase,
    inputs: Inputs,
    includes: Includes,
    state: GraphicsState,
    entities: Entities,
    objects: Objects,
    materials: Materials,
    /// The number of `Shape` statements so far.
    shape_count: u32,
    census: Census,
    locations: Option<Locations>,
    warnings: Warnings,
}

/// How far the scene has been read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// Before `WorldBegin`.
    Options,
    /// After `WorldBegin`.
    World,
    /// After `WorldEnd`.
    Ended,
}

impl<'a> Interpreter<'a> {
    pub(super) fn new(
        path: &Path,
        options: &LoadOptions,
        progress: Progress<'a>,
    ) -> Interpreter<'a> {
        Interpreter {
            path: path.to_path_buf(),
            options: *options,
            progress,
            stops_at_world: false,
            phase: Phase::Options,
            inputs: Inputs::new(path, options.input_budget),
            includes: Includes::default(),
            state: GraphicsState::new(options.transform_history),
            entities: Entities::default(),
            objects: Objects::default(),
            materials: Materials::default(),
            shape_count: 0,
            census: Census::default(),
            locations: options.locations.then(Locations::default),
            warnings: Warnings::default(),
        }
    }

    /// Reads the scene no further than `WorldBegin`: the file name of its film, and its
    /// accelerator.
    pub(super) fn read_options(mut self) -> Result<(Option<String>, AcceleratorParameters)> {
        self.stops_at_world = true;
        self.read_top_level()?;
        Ok(self.entities.into_names())
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
        self.read(Arc::new(SourceFile::new(&self.path, text)), false)
            .map(|_| ())
    }

    /// The files that were read, or tried.
    pub(super) fn take_files(&mut self) -> InputFiles {
        self.inputs.take_files()
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
                Some(Err(_)) if self.phase == Phase::Ended => return Ok(None),
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
            if self.phase == Phase::Ended {
                let message = "what follows WorldEnd is ignored: one world is one picture";
                let at = keyword.beside(&directive.span);
                self.warnings
                    .add("after the world", || at.diagnostic(message));
                return Ok(None);
            }
            let includes = matches!(directive.statement, Statement::Include(_));
            if is_continued && !includes && directives.next_is() == Next::End {
                return Ok(Some(Tail::new(file, start)));
            }
            self.census.count(&directive);
            let tail = match &directive.statement {
                Statement::Include(name) => {
                    self.include_and_continue(name, &keyword, &mut directives, is_continued)?
                }
                _ => self.execute(&directive, &keyword).map(|()| None)?,
            };
            if tail.is_some() || (self.stops_at_world && self.phase != Phase::Options) {
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

    /// Like `Include`, but changes of the graphics state and names of coordinate systems end with
    /// the file; objects and materials stay.
    fn import(&mut self, name: &Text, keyword: &SourceSpan) -> Result<()> {
        let is_in_object = self.objects.is_open();
        self.state.begin(Block::Import, keyword);
        self.include(name, keyword, false)?;
        self.state.close_blocks(&mut self.warnings);
        if !is_in_object {
            self.objects.end(&mut self.warnings);
        }
        self.state.end_import();
        Ok(())
    }

    fn execute(&mut self, directive: &Directive, keyword: &SourceSpan) -> Result<()> {
        self.check_legal(directive, keyword)?;
        let (state, warnings) = (&mut self.state, &mut self.warnings);
        match &directive.statement {
            Statement::Transform(transform) => {
                let at = keyword.beside(&directive.span);
                state.transform.apply(transform, &at, warnings);
            }
            Statement::ActiveTransform(active) => state.transform.set_active(*active),
            Statement::CoordinateSystem(name) => state.transform.set_coordinate_system(name),
            Statement::CoordSysTransform(name) => state.transform.recall(name, keyword, warnings),
            Statement::ReverseOrientation => state.reverses_orientation ^= true,
            Statement::AreaLightSource => state.is_light = true,
            Statement::AttributeBegin => state.begin(Block::Attribute, keyword),
            Statement::AttributeEnd => state.end(Block::Attribute, keyword, warnings),
            Statement::TransformBegin => state.begin(Block::Transform, keyword),
            Statement::TransformEnd => state.end(Block::Transform, keyword, warnings),
            Statement::Attribute(entity) => state.set_defaults(entity, keyword)?,
            Statement::Material(name) => state.material = Material::of_type(name),
            Statement::NamedMaterial(name) => {
                state.material = self.materials.named(name, &state.material);
            }
            Statement::MakeNamedMaterial(entity) => {
                self.materials.make(entity, keyword, warnings);
            }
            Statement::ObjectBegin(name) => {
                self.objects.begin(name, keyword, warnings);
                state.begin(Block::Object, keyword);
            }
            Statement::ObjectEnd => {
                state.end(Block::Object, keyword, warnings);
                self.objects.end(warnings);
            }
            Statement::WorldBegin => {
                self.phase = Phase::World;
                state.begin_world();
            }
            Statement::WorldEnd => self.phase = Phase::Ended,
            Statement::Camera(entity) => {
                self.entities
                    .set_camera(entity, keyword, &mut state.transform, warnings)?;
            }
            Statement::Film(entity) => self.entities.set_film(entity, keyword, warnings)?,
            Statement::Accelerator(entity) => {
                self.entities.set_accelerator(entity, keyword, warnings)?;
            }
            Statement::Import(name) => self.import(name, keyword)?,
            Statement::ObjectInstance(name) => self.instance(name, keyword)?,
            Statement::Shape(entity) => self.shape(entity, keyword)?,
            Statement::Unknown(name) => warnings.add(format!("directive {name}"), || {
                let message =
                    format!("`{name}` is not a directive of pbrt: skipped with its arguments");
                let note = "if it places geometry, that is missing from the picture";
                keyword.diagnostic(message).note(note)
            }),
            Statement::Include(_) | Statement::Skipped => {}
        }
        Ok(())
    }

    /// # Errors
    /// A directive on the wrong side of `WorldBegin`.
    fn check_legal(&self, directive: &Directive, keyword: &SourceSpan) -> Result<()> {
        let Some(description) = directive.description else {
            return Ok(());
        };
        let name = KEYWORDS[description.number];
        match (description.legal, self.phase) {
            (Legal::BeforeWorld, Phase::World | Phase::Ended) if name == "WorldBegin" => {
                Err(keyword.error("a second WorldBegin"))
            }
            (Legal::BeforeWorld, Phase::World | Phase::Ended) => {
                let error = keyword.error(format!("{name} inside the world"));
                Err(error.note("expected before WorldBegin"))
            }
            (Legal::InWorld, Phase::Options) => {
                let error = keyword.error(format!("{name} outside the world"));
                let error = error.note("expected after WorldBegin");
                Err(error.note(match name {
                    "Import" => "Include reads a file anywhere",
                    _ => "or is this file a part that another one includes?",
                }))
            }
            _ => Ok(()),
        }
    }

    /// Shapes and instances are rendered where they are at the start time.
    fn warn_if_moving(&mut self, at: &SourceSpan) {
        if self.state.transform.is_moving() {
            let message =
                "moving shapes are not supported: they stand where they are at the start time";
            self.warnings.add("moving", || at.diagnostic(message));
        }
    }

    fn instance(&mut self, name: &Text, keyword: &SourceSpan) -> Result<()> {
        if self.objects.is_open() {
            let error = keyword.error("an instance within an object");
            return Err(error.note("expected ObjectInstance after ObjectEnd: objects do not nest"));
        }
        self.state
            .transform
            .check_usable("ObjectInstance", keyword)?;
        self.warn_if_moving(keyword);
        let world_from_instance = self.state.transform.start().matrix;
        self.objects
            .add_instance(name, keyword, world_from_instance, &mut self.warnings)?;
        self.state.transform.record_instance();
        if let Some(locations) = &mut self.locations {
            locations.add_instance(keyword);
        }
        Ok(())
    }

    fn shape(&mut self, entity: &Entity, keyword: &SourceSpan) -> Result<()> {
        let number = self.next_shape(entity, keyword)?;
        let name = &entity.name.text;
        let is_light = self.state.is_light;
        let bounds_medium = self.state.material.only_bounds_media(is_light);
        if bounds_medium {
            self.census.add_boundary(name, || keyword.location());
        } else if shapes::is_supported(name) {
            self.state.transform.check_usable("Shape", keyword)?;
            self.warn_if_moving(keyword);
        }
        self.materials.wait(&self.state.material, number, is_light);
        let world_from_object = self.state.transform.start().matrix;
        let is_turned = self.state.reverses_orientation != world_from_object.swaps_handedness();
        let is_in_object = self.objects.is_open();
        let store = self.objects.store();
        let mut target = ShapeTarget {
            geometry: &mut store.geometry,
            transforms: &mut store.transforms,
            warnings: &mut self.warnings,
            inputs: &mut self.inputs,
            options: &self.options,
            number,
            world_from_object,
            is_in_object,
            is_turned,
            bounds_medium,
        };
        let before = target.geometry.own_count();
        let parameters = Parameters::of_shape(entity, keyword.file(), &self.state.defaults)?;
        let is_added = shapes::add(parameters, &mut target)?;
        let added = target.geometry.own_count() - before;
        self.census.count_shape(name, is_added.then_some(added));
        Ok(())
    }

    /// Numbers a `Shape` statement.
    fn next_shape(&mut self, entity: &Entity, keyword: &SourceSpan) -> Result<u32> {
        let Some(number) = self.shape_count.checked_add(1) else {
            return Err(keyword.error(format!("the scene has more than {} shapes", u32::MAX)));
        };
        self.shape_count = number;
        self.state.transform.record_shape();
        if let Some(locations) = &mut self.locations {
            locations.add_shape(&entity.name.text, keyword);
        }
        Ok(number)
    }

    /// The scene, once all directives have been executed.
    pub(super) fn finish(mut self) -> Result<Scene> {
        self.state.close_blocks(&mut self.warnings);
        self.objects.end(&mut self.warnings);
        self.objects.define_awaited()?;
        self.objects.hide(&self.materials.late_boundaries());
        self.census.set_unused(self.objects.unused(MAX_LISTED));
        if self.phase == Phase::Options {
            let diagnostic = Diagnostic::new("the scene has no WorldBegin")
                .at(SourceLocation::file(&self.path))
                .note("expected Camera and Film, WorldBegin, and then the shapes");
            return Err(Error::bad_input(diagnostic));
        }
        let resolution = self.options.resolution;
        let (camera, film, accelerator) = self.entities.resolve(&self.path, resolution)?;
        let (geometry, transform_count) = self.objects.finish();
        Ok(Scene {
            camera,
            film,
            accelerator,
            geometry,
            shape_count: self.shape_count,
            transform_count,
            warnings: self.warnings,
            census: self.census,
            locations: self.locations,
            transform_history: self.state.transform.into_history(),
        })
    }
}
