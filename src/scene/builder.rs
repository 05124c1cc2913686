//! From directives to a scene: the interpreter of scene files.

use super::accelerator::AcceleratorParameters;
use super::blocks::Block;
use super::camera_parameters::CameraParameters;
use super::census::{Census, MAX_LISTED};
use super::film::FilmParameters;
use super::graphics_state::GraphicsState;
use super::includes::{Includes, Tail};
use super::materials::{Material, Materials};
use super::mesh_cache::MeshCache;
use super::name::Name;
use super::objects::Objects;
use super::parser::{
    Directive, Directives, Next, Span, Statement, Text, end_of_arguments, is_last,
};
use super::places::Places;
use super::source::{Place, Source};
use super::transform_cache::TransformCache;
use super::warnings::Warnings;
use super::{LoadOptions, Roundings, Scene, SceneOptions};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::file_id::InputFiles;
use crate::geometry::{RoundedTransform, Transform, Vector};
use crate::input::{Budget, BudgetFactor};
use crate::progress::Progress;
use crate::shape::Geometry;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

/// A scene in the making.
pub(super) struct Builder<'a> {
    path: PathBuf,
    /// Relative names count from here: the directory of the top-level file, as in pbrt.
    pub(super) directory: PathBuf,
    progress: Progress<'a>,
    only_options: bool,
    pub(super) state: GraphicsState,
    pub(super) in_world: bool,
    /// Nothing further is to be read.
    ended: bool,
    /// Why the current transform first had no finite inverse, and where.
    pub(super) singular: Option<(&'static str, Place)>,
    pub(super) camera: Option<CameraParameters>,
    pub(super) film: FilmParameters,
    pub(super) film_place: Option<Place>,
    pub(super) accelerator: AcceleratorParameters,
    pub(super) geometry: Geometry,
    pub(super) objects: Objects,
    pub(super) materials: Materials,
    pub(super) shape_count: u32,
    pub(super) transforms: TransformCache,
    pub(super) warnings: Warnings,
    pub(super) census: Census,
    pub(super) includes: Includes,
    /// All files that are read.
    pub(super) files: InputFiles,
    /// If they are wanted.
    pub(super) places: Option<Places>,
    /// Filled where roundings are followed.
    pub(super) roundings: Option<Roundings>,
    pub(super) keeps_orientation: bool,
    pub(super) keeps_uv: bool,
    /// What the scene's files may expand to.
    pub(super) budget: Budget,
    /// Meshes that are named more than once.
    pub(super) mesh_cache: MeshCache,
}

impl<'a> Builder<'a> {
    pub(super) fn new(path: &Path, factor: BudgetFactor, progress: Progress<'a>) -> Builder<'a> {
        Builder {
            path: path.to_path_buf(),
            directory: path.parent().unwrap_or(Path::new("")).to_path_buf(),
            progress,
            only_options: false,
            state: GraphicsState::new(),
            in_world: false,
            ended: false,
            singular: None,
            camera: None,
            film: FilmParameters::default(),
            film_place: None,
            accelerator: AcceleratorParameters::default(),
            geometry: Geometry::default(),
            objects: Objects::default(),
            materials: Materials::default(),
            shape_count: 0,
            transforms: TransformCache::default(),
            warnings: Warnings::default(),
            census: Census::default(),
            includes: Includes::default(),
            files: InputFiles::default(),
            places: None,
            roundings: None,
            keeps_orientation: false,
            keeps_uv: false,
            budget: Budget::new(factor),
            mesh_cache: MeshCache::default(),
        }
    }

    /// The same, keeping what is wanted from the first directive on.
    pub(super) fn with_options(
        path: &Path,
        options: &LoadOptions,
        progress: Progress<'a>,
    ) -> Builder<'a> {
        let mut builder = Builder::new(path, options.input_budget, progress);
        builder.places = options.places.then(Places::default);
        builder.state.rounded = options
            .roundings
            .then(|| Arc::new(RoundedTransform::IDENTITY));
        builder.roundings = options.roundings.then(Roundings::default);
        (builder.keeps_orientation, builder.keeps_uv) = (options.orientation, options.uv);
        builder
    }

    /// Reads a scene no further than `WorldBegin`.
    pub(super) fn read_options(mut self) -> Result<SceneOptions> {
        self.only_options = true;
        self.read_top_level()?;
        Ok(SceneOptions {
            film_filename: self.film.filename,
            accelerator: self.accelerator,
        })
    }

    /// Obeys the directives of the file that the builder is for.
    pub(super) fn read_top_level(&mut self) -> Result<()> {
        self.files.add_named(&self.path);
        let source = Source::read_top_level(&self.path, &self.budget)?;
        self.read(Rc::new(source), false).map(|_| ())
    }

    /// Obeys the directives in `text`, as if it were the file that the builder is for.
    pub(super) fn read_text(&mut self, text: Vec<u8>) -> Result<()> {
        self.budget.enter_bytes(text.len() as u64);
        self.read(Rc::new(Source::new(&self.path, text)), false)
            .map(|_| ())
    }

    /// Obeys the directives of one file and of those that it includes. Where the file `is_continued` by arguments
    /// behind its `Include`, the last directive is handed back.
    pub(super) fn read(&mut self, source: Rc<Source>, is_continued: bool) -> Result<Option<Tail>> {
        self.includes.enter(&source.path);
        self.places
            .iter_mut()
            .for_each(|places| places.enter(&source.path));
        let tail = self.read_directives(&source, is_continued)?;
        self.includes.leave();
        self.places.iter_mut().for_each(Places::leave);
        Ok(tail)
    }

    fn read_directives(&mut self, source: &Rc<Source>, is_continued: bool) -> Result<Option<Tail>> {
        let mut directives = source.directives();
        let mut seen = 0;
        loop {
            // Only a directive that is handed back has to be found again.
            let start = if is_continued { directives.offset() } else { 0 };
            let directive = match directives.next() {
                None => return Ok(None),
                // What follows the end of the world may be anything.
                Some(Err(_)) if self.ended => return Ok(None),
                // Perhaps only since the rest of it is in another file.
                Some(Err(_)) if is_continued && is_last(&source.text, start) => {
                    return Ok(Some(Tail::new(source, start)));
                }
                Some(directive) => directive?,
            };
            if !source.is_spliced() {
                self.progress.advance(directive.span.end - seen);
                seen = directive.span.end;
            }
            if self.ended {
                self.warn_of_the_rest(&directive, source);
                return Ok(None);
            }
            let includes = matches!(directive.statement, Statement::Include(_));
            if is_continued && !includes && directives.next_is() == Next::End {
                return Ok(Some(Tail::new(source, start)));
            }
            self.census.count(&directive);
            let tail = match &directive.statement {
                Statement::Include(name) => {
                    self.include_and_go_on(name, source, &mut directives, is_continued)?
                }
                _ => self.obey(&directive, source).map(|()| None)?,
            };
            if tail.is_some() || (self.only_options && self.in_world) {
                return Ok(tail);
            }
        }
    }

    /// Reads an included file, and its last directive together with the arguments that follow the `Include`, which the
    /// `directives` of `source` have just passed.
    fn include_and_go_on(
        &mut self,
        name: &Text,
        source: &Rc<Source>,
        directives: &mut Directives,
        is_continued: bool,
    ) -> Result<Option<Tail>> {
        let goes_on = match directives.next_is() {
            Next::Argument => true,
            Next::End => is_continued,
            Next::Directive => false,
        };
        let Some(tail) = self.include(name, source, goes_on)? else {
            return Ok(None);
        };
        let start = directives.offset();
        let end = end_of_arguments(&source.text, start);
        directives.go_to(end);
        let is_continued = is_continued && directives.next_is() == Next::End;
        if is_continued && start == end {
            return Ok(Some(tail));
        }
        self.read_directives(&tail.with(source, start..end), is_continued)
    }

    fn warn_of_the_rest(&mut self, directive: &Directive, source: &Source) {
        let message = "what follows WorldEnd is ignored: one world is one picture";
        self.warnings.add("after the world", || {
            Diagnostic::new(message).at(source.at(&directive.span))
        });
    }

    fn obey(&mut self, directive: &Directive, source: &Rc<Source>) -> Result<()> {
        let keyword = &directive.keyword;
        match &directive.statement {
            Statement::Identity => self.replace(Transform::IDENTITY, directive, source),
            Statement::Translate(offset) => {
                self.concat(Transform::translate(*offset), directive, source)
            }
            Statement::Scale(factors) => self.concat(Transform::scale(*factors), directive, source),
            Statement::Rotate([angle, x, y, z]) => {
                self.concat(
                    Transform::rotate(*angle, Vector::new(*x, *y, *z)),
                    directive,
                    source,
                );
            }
            Statement::LookAt(numbers) => self.look_at(numbers, directive, source),
            Statement::Transform(m) | Statement::ConcatTransform(m) => {
                self.numbers(m, directive, source)
            }
            Statement::ActiveTransform(active) => self.state.active = *active,
            Statement::CoordinateSystem(name) => self.state.name(Name::new(name)),
            Statement::CoordSysTransform(name) => self.recall(name, source),
            Statement::ReverseOrientation => self.state.reverses_orientation ^= true,
            Statement::Ignored("AreaLightSource") => self.state.is_light = true,
            Statement::TransformTimes(_) | Statement::Ignored(_) => {}
            Statement::AttributeBegin => self
                .state
                .begin(Block::Attribute, Place::new(source, keyword)),
            Statement::AttributeEnd => self.end(Block::Attribute, keyword, source),
            Statement::TransformBegin => self
                .state
                .begin(Block::Transform, Place::new(source, keyword)),
            Statement::TransformEnd => self.end(Block::Transform, keyword, source),
            Statement::ObjectBegin(name) => self.begin_object(name, keyword, source)?,
            Statement::ObjectEnd => self.end_object(keyword, source),
            Statement::ObjectInstance(name) => self.instance(name, keyword, source)?,
            Statement::WorldBegin => self.begin_world(keyword, source)?,
            Statement::WorldEnd => self.end_world(keyword, source)?,
            Statement::Include(_) => {}
            Statement::Import(name) => self.import(name, keyword, source)?,
            Statement::Material(name) => self.state.material = Material::of_type(name),
            Statement::MakeNamedMaterial(entity) => self.make_material(entity, source),
            Statement::NamedMaterial(name) => {
                self.state.material = self.materials.named(name, &self.state.material);
            }
            Statement::Attribute(entity) => self.attribute(entity, source)?,
            Statement::Camera(entity) => self.camera(entity, keyword, source)?,
            Statement::Film(entity) => self.film(entity, keyword, source)?,
            Statement::Accelerator(entity) => self.accelerator(entity, source)?,
            Statement::Shape(entity) => self.shape(entity, keyword, source)?,
            Statement::Private(name) => self.warn_of_private(name, keyword, source),
        }
        Ok(())
    }

    fn warn_of_private(&mut self, name: &str, keyword: &Span, source: &Source) {
        self.warnings.add(format!("directive {name}"), || {
            let diagnostic = Diagnostic::new(format!(
                "`{name}` is no directive of pbrt: skipped with its arguments"
            ));
            diagnostic
                .at(source.at(keyword))
                .note("if it places geometry, that is missing from the picture")
        });
    }

    fn begin_world(&mut self, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        if self.in_world {
            return Err(source.error(keyword, "a second WorldBegin"));
        }
        self.in_world = true;
        self.state.begin_world();
        Ok(())
    }

    fn end_world(&mut self, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        if !self.in_world {
            return Err(source.error(keyword, "WorldEnd without WorldBegin"));
        }
        self.ended = true;
        Ok(())
    }

    /// Geometry belongs after `WorldBegin`.
    pub(super) fn check_in_world(
        &self,
        name: &str,
        keyword: &Span,
        source: &Rc<Source>,
    ) -> Result<()> {
        if self.in_world {
            return Ok(());
        }
        let error = source
            .error(keyword, format!("{name} outside the world"))
            .note("expected after WorldBegin");
        Err(error.note("or is this file a part that another one includes?"))
    }

    /// What moves is rendered where it is at the start time.
    pub(super) fn warn_if_moving(&mut self, keyword: &Span, source: &Source) {
        if self.state.is_moving() {
            let message =
                "moving shapes are not supported: they stand where they are at the start time";
            self.warnings
                .add("moving", || Diagnostic::new(message).at(source.at(keyword)));
        }
    }

    /// The scene, when all has been read.
    pub(super) fn finish(mut self, options: &LoadOptions) -> Result<Scene> {
        self.close_blocks();
        self.define_object();
        self.define_awaited()?;
        self.geometry.hide(&self.materials.late_boundaries());
        self.census.set_unused(self.objects.unused(MAX_LISTED));
        if !self.in_world {
            let diagnostic =
                Diagnostic::new("the scene has no WorldBegin").at(SourceLocation::file(&self.path));
            return Err(Error::bad_input(
                diagnostic.note("expected Camera and Film, WorldBegin, and then the shapes"),
            ));
        }
        let film =
            self.film
                .resolve(options.resolution)
                .map_err(|message| match self.film_place {
                    Some(place) => place.error(message),
                    None => Error::bad_input(
                        Diagnostic::new(message).at(SourceLocation::file(&self.path)),
                    ),
                })?;
        let camera = self
            .camera
            .unwrap_or_else(CameraParameters::default_camera)
            .resolve(film.resolution);
        Ok(Scene {
            camera,
            film,
            accelerator: self.accelerator,
            geometry: self.geometry,
            shape_count: self.shape_count,
            transform_count: self.transforms.len() + self.objects.transform_count,
            warnings: self.warnings,
            census: self.census,
            places: self.places,
            roundings: self.roundings,
        })
    }
}
