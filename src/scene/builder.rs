//! From directives to a scene: the interpreter of scene files.

use super::accelerator::AcceleratorParameters;
use super::camera_parameters::CameraParameters;
use super::census::Census;
use super::film::FilmParameters;
use super::graphics_state::{Block, GraphicsState};
use super::includes::Includes;
use super::mesh_cache::MeshCache;
use super::objects::{Definition, Objects};
use super::parameters::Parameters;
use super::parser::{Directive, Directives, Entity, Span, Statement};
use super::places::Places;
use super::shape_statement::ShapeTarget;
use super::source::{Place, Source};
use super::transform_cache::TransformCache;
use super::transform_directives::affine;
use super::warnings::Warnings;
use super::{LoadOptions, Roundings, Scene, SceneOptions};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::{RoundedTransform, Transform, Vector};
use crate::input::{Budget, BudgetFactor};
use crate::progress::Progress;
use crate::shape::Shapes;
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
    pub(super) shapes: Shapes,
    pub(super) objects: Objects,
    shape_count: u32,
    transforms: TransformCache,
    pub(super) warnings: Warnings,
    census: Census,
    pub(super) includes: Includes,
    /// If they are wanted.
    pub(super) places: Option<Places>,
    /// Filled where roundings are followed.
    pub(super) roundings: Option<Roundings>,
    keeps_orientation: bool,
    keeps_uv: bool,
    /// What the scene's files may expand to.
    pub(super) budget: Budget,
    /// Meshes that are named more than once.
    mesh_cache: MeshCache,
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
            shapes: Shapes::default(),
            objects: Objects::default(),
            shape_count: 0,
            transforms: TransformCache::default(),
            warnings: Warnings::default(),
            census: Census::default(),
            includes: Includes::default(),
            places: None,
            roundings: None,
            keeps_orientation: false,
            keeps_uv: false,
            budget: Budget::new(factor),
            mesh_cache: MeshCache::default(),
        }
    }

    /// The same, keeping what is wanted from the first directive on.
    pub(super) fn with_options(path: &Path, options: &LoadOptions, progress: Progress<'a>) -> Builder<'a> {
        let mut builder = Builder::new(path, options.input_budget, progress);
        builder.places = options.places.then(Places::default);
        builder.state.rounded = options.roundings.then(|| Arc::new(RoundedTransform::IDENTITY));
        builder.roundings = options.roundings.then(Roundings::default);
        (builder.keeps_orientation, builder.keeps_uv) = (options.orientation, options.uv);
        builder
    }

    /// Reads a scene no further than `WorldBegin`.
    pub(super) fn read_options(mut self) -> Result<SceneOptions> {
        self.only_options = true;
        self.read_top_level()?;
        Ok(SceneOptions { film_filename: self.film.filename, accelerator: self.accelerator })
    }

    /// Obeys the directives of the file that the builder is for.
    pub(super) fn read_top_level(&mut self) -> Result<()> {
        let source = Source::read_top_level(&self.path, &self.budget)?;
        self.read(Rc::new(source))
    }

    /// Obeys the directives in `text`, as if it were the file that the builder is for.
    pub(super) fn read_text(&mut self, text: Vec<u8>) -> Result<()> {
        self.budget.enter_bytes(text.len() as u64);
        self.read(Rc::new(Source { path: self.path.clone(), text }))
    }

    /// Obeys the directives of one file and of those that it includes.
    pub(super) fn read(&mut self, source: Rc<Source>) -> Result<()> {
        self.includes.enter(&source.path);
        self.places.iter_mut().for_each(|places| places.enter(&source.path));
        let mut seen = 0;
        for directive in Directives::new(&source.path, &source.text) {
            let directive = match directive {
                // What follows the end of the world may be anything.
                Err(_) if self.ended => break,
                directive => directive?,
            };
            self.progress.advance(directive.span.end - seen);
            seen = directive.span.end;
            if self.ended {
                self.warn_of_the_rest(&directive, &source);
                break;
            }
            self.census.count(&directive);
            self.obey(&directive, &source)?;
            if self.only_options && self.in_world {
                break;
            }
        }
        self.includes.leave();
        self.places.iter_mut().for_each(Places::leave);
        Ok(())
    }

    fn warn_of_the_rest(&mut self, directive: &Directive, source: &Source) {
        let message = "what follows WorldEnd is ignored: one world is one picture";
        self.warnings.add("after the world", || Diagnostic::new(message).at(source.at(&directive.span)));
    }

    fn obey(&mut self, directive: &Directive, source: &Rc<Source>) -> Result<()> {
        let keyword = &directive.keyword;
        match &directive.statement {
            Statement::Identity => self.replace(Transform::IDENTITY, directive, source),
            Statement::Translate(offset) => self.concat(Transform::translate(*offset), directive, source),
            Statement::Scale(factors) => self.concat(Transform::scale(*factors), directive, source),
            Statement::Rotate([angle, x, y, z]) => {
                self.concat(Transform::rotate(*angle, Vector::new(*x, *y, *z)), directive, source);
            }
            Statement::LookAt(numbers) => self.look_at(numbers, directive, source),
            Statement::Transform(m) => self.replace(affine(m, directive, source)?, directive, source),
            Statement::ConcatTransform(m) => self.concat(affine(m, directive, source)?, directive, source),
            Statement::ActiveTransform(active) => self.state.active = *active,
            Statement::CoordinateSystem(name) => self.state.name(&name.text),
            Statement::CoordSysTransform(name) => self.recall(name, source),
            Statement::ReverseOrientation => self.state.reverses_orientation ^= true,
            Statement::TransformTimes(_) | Statement::Ignored(_) => {}
            Statement::AttributeBegin => self.state.begin(Block::Attribute, Place::new(source, keyword)),
            Statement::AttributeEnd => self.end(Block::Attribute, keyword, source)?,
            Statement::TransformBegin => self.state.begin(Block::Transform, Place::new(source, keyword)),
            Statement::TransformEnd => self.end(Block::Transform, keyword, source)?,
            Statement::ObjectBegin(name) => self.begin_object(name, keyword, source)?,
            Statement::ObjectEnd => self.end_object(keyword, source)?,
            Statement::ObjectInstance(name) => self.instance(name, keyword, source)?,
            Statement::WorldBegin => self.begin_world(keyword, source)?,
            Statement::WorldEnd => self.end_world(keyword, source)?,
            Statement::Include(name) => self.include(name, source)?,
            Statement::Import(name) => self.import(name, keyword, source)?,
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
            let diagnostic = Diagnostic::new(format!("`{name}` is no directive of pbrt: skipped with its arguments"));
            diagnostic.at(source.at(keyword)).note("if it places geometry, that is missing from the picture")
        });
    }

    pub(super) fn end(&mut self, block: Block, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        self.state.end(block).map_err(|open| match open {
            None => source.error(keyword, format!("{} without {}", block.end(), block.begin())),
            Some(open) => {
                let message = format!("{} closes a block that {} began", block.end(), open.begin());
                source.error(keyword, message).note(format!("expected {}", open.end()))
            }
        })
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
    pub(super) fn check_in_world(&self, name: &str, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        if self.in_world {
            return Ok(());
        }
        let error = source.error(keyword, format!("{name} outside the world")).note("expected after WorldBegin");
        Err(error.note("or is this file a part that another one includes?"))
    }

    /// What moves is rendered where it is at the start time.
    pub(super) fn warn_if_moving(&mut self, keyword: &Span, source: &Source) {
        if self.state.is_moving() {
            let message = "moving shapes are not supported: they stand where they are at the start time";
            self.warnings.add("moving", || Diagnostic::new(message).at(source.at(keyword)));
        }
    }

    fn shape(&mut self, entity: &Entity, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        self.check_in_world("Shape", keyword, source)?;
        let Some(number) = self.shape_count.checked_add(1) else {
            return Err(source.error(keyword, format!("the scene has more than {} shapes", u32::MAX)));
        };
        self.shape_count = number;
        let name = &entity.name.text;
        self.places.iter_mut().for_each(|places| places.add_shape(name, keyword, &source.text));
        if let (Some(roundings), Some(rounded)) = (&mut self.roundings, &self.state.rounded) {
            roundings.shapes.push(Arc::clone(rounded));
        }
        self.warn_if_moving(keyword, source);
        let is_in_object = self.objects.open.is_some();
        let (shapes, transforms) = match &mut self.objects.open {
            Some(Definition { shapes, transforms, .. }) => (shapes, transforms),
            None => (&mut self.shapes, &mut self.transforms),
        };
        let world_from_object = self.state.current.matrix;
        let is_turned = || self.state.reverses_orientation != world_from_object.swaps_handedness();
        let mut target = ShapeTarget {
            shapes,
            transforms,
            warnings: &mut self.warnings,
            directory: &self.directory,
            number,
            world_from_object,
            is_in_object,
            is_turned: self.keeps_orientation && is_turned(),
            keeps_uv: self.keeps_uv,
            budget: &self.budget,
            mesh_cache: &mut self.mesh_cache,
        };
        let before = target.shapes.own_count();
        let is_added = target.add(Parameters::of_shape(entity, source, &self.state.defaults)?)?;
        let added = target.shapes.own_count() - before;
        self.census.count_shape(&entity.name.text, is_added.then_some(added));
        Ok(())
    }

    /// No block is open, or the innermost is an `outer`.
    pub(super) fn check_closed_but_for(&self, outer: Option<Block>) -> Result<()> {
        match self.state.innermost() {
            Some(open) if Some(open.block) != outer => {
                Err(open.place.error(format!("{} without {}", open.block.begin(), open.block.end())))
            }
            _ => Ok(()),
        }
    }

    /// The scene, when all has been read.
    pub(super) fn finish(self, options: &LoadOptions) -> Result<Scene> {
        self.check_closed_but_for(None)?;
        if !self.in_world {
            let diagnostic = Diagnostic::new("the scene has no WorldBegin").at(SourceLocation::file(&self.path));
            return Err(Error::bad_input(diagnostic.note("expected Camera and Film, WorldBegin, and then the shapes")));
        }
        let film = self.film.resolve(options.resolution).map_err(|message| match self.film_place {
            Some(place) => place.error(message),
            None => Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(&self.path))),
        })?;
        let camera = self.camera.unwrap_or_else(CameraParameters::default_camera).resolve(film.resolution);
        Ok(Scene {
            camera,
            film,
            accelerator: self.accelerator,
            shapes: self.shapes,
            shape_count: self.shape_count,
            transform_count: self.transforms.len() + self.objects.transform_count,
            warnings: self.warnings,
            census: self.census,
            places: self.places,
            roundings: self.roundings,
        })
    }
}
