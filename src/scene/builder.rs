//! From directives to a scene: the interpreter of scene files.

use super::accelerator::AcceleratorParameters;
use super::camera_parameters::CameraParameters;
use super::film::FilmParameters;
use super::graphics_state::{Block, GraphicsState};
use super::objects::{Definition, Objects};
use super::parameters::Parameters;
use super::parser::{ActiveTransform, Directive, Directives, Entity, Span, Statement, Text};
use super::shape_statement::ShapeTarget;
use super::source::{Place, Source};
use super::transform_cache::TransformCache;
use super::transform_directives::affine;
use super::warnings::Warnings;
use super::{LoadOptions, Scene, SceneOptions};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::{Transform, Vector};
use crate::progress::Progress;
use crate::shape::Shapes;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Files that include each other, at most.
const MAX_INCLUDE_DEPTH: usize = 64;

/// Files read, at most: a few that include each other twice would be read for ever.
const MAX_FILES: usize = 100_000;

/// A scene in the making.
pub(super) struct Builder<'a> {
    path: PathBuf,
    /// Relative names count from here: the directory of the top-level file, as in pbrt.
    directory: PathBuf,
    progress: Progress<'a>,
    only_options: bool,
    pub(super) state: GraphicsState,
    /// Which of two transforms the directives change; only that of the start time is kept.
    pub(super) active: ActiveTransform,
    in_world: bool,
    /// Nothing further is to be read.
    ended: bool,
    /// Why the current transform first had no finite inverse, and where.
    pub(super) singular: Option<(&'static str, Place)>,
    camera: Option<CameraParameters>,
    film: FilmParameters,
    film_place: Option<Place>,
    accelerator: AcceleratorParameters,
    pub(super) shapes: Shapes,
    pub(super) objects: Objects,
    shape_count: u32,
    transforms: TransformCache,
    pub(super) warnings: Warnings,
    skipped: BTreeMap<&'static str, u64>,
    /// The files being read, each included by the one before.
    reading: Vec<PathBuf>,
    files_read: usize,
}

impl<'a> Builder<'a> {
    pub(super) fn new(path: &Path, progress: Progress<'a>) -> Builder<'a> {
        Builder {
            path: path.to_path_buf(),
            directory: path.parent().unwrap_or(Path::new("")).to_path_buf(),
            progress,
            only_options: false,
            state: GraphicsState::new(),
            active: ActiveTransform::All,
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
            skipped: BTreeMap::new(),
            reading: Vec::new(),
            files_read: 0,
        }
    }

    /// Reads a scene no further than `WorldBegin`.
    pub(super) fn read_options(mut self) -> Result<SceneOptions> {
        self.only_options = true;
        self.read_top_level()?;
        Ok(SceneOptions { film_filename: self.film.filename, accelerator: self.accelerator })
    }

    /// Obeys the directives of the file that the builder is for.
    pub(super) fn read_top_level(&mut self) -> Result<()> {
        let source = Source::read_top_level(&self.path)?;
        self.read(Rc::new(source))
    }

    /// Obeys the directives in `text`, as if it were the file that the builder is for.
    pub(super) fn read_text(&mut self, text: Vec<u8>) -> Result<()> {
        self.read(Rc::new(Source { path: self.path.clone(), text }))
    }

    /// Obeys the directives of one file and of those that it includes.
    fn read(&mut self, source: Rc<Source>) -> Result<()> {
        let path = &source.path;
        let identity = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
        self.reading.push(identity);
        self.files_read += 1;
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
            self.obey(&directive, &source)?;
            if self.only_options && self.in_world {
                break;
            }
        }
        self.reading.pop();
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
            Statement::TransformTimes(_) => *self.skipped.entry("TransformTimes").or_default() += 1,
            Statement::ActiveTransform(active) => self.activate(*active, directive, source),
            Statement::CoordinateSystem(name) => self.state.name(&name.text, self.state.current),
            Statement::CoordSysTransform(name) => self.recall(name, source),
            Statement::ReverseOrientation => {}
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
            Statement::Import(name) => {
                let current = self.state.current;
                self.include(name, source)?;
                self.state.current = current;
            }
            Statement::Attribute(entity) => self.attribute(entity, source),
            Statement::Camera(entity) => self.camera(entity, keyword, source)?,
            Statement::Film(entity) => self.film(entity, keyword, source)?,
            Statement::Accelerator(entity) => {
                let mut parameters = Parameters::new("Accelerator", entity, source);
                self.accelerator = AcceleratorParameters::read(&mut parameters)?;
                parameters.finish_with_suggestions(&mut self.warnings);
            }
            Statement::Shape(entity) => self.shape(entity, keyword, source)?,
            Statement::Ignored(keyword) => *self.skipped.entry(keyword).or_default() += 1,
        }
        Ok(())
    }

    /// Of the defaults that v4 can set, only those of shapes may matter.
    fn attribute(&mut self, entity: &Entity, source: &Rc<Source>) {
        if entity.name.text == "shape" {
            let message = "parameters of following shapes set by Attribute are ignored";
            self.warnings.add("Attribute shape", || Diagnostic::new(message).at(source.at(&entity.name.span)));
        } else {
            *self.skipped.entry("Attribute").or_default() += 1;
        }
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
        self.state.current = Transform::IDENTITY;
        self.state.name("world", Transform::IDENTITY);
        Ok(())
    }

    fn end_world(&mut self, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        if !self.in_world {
            return Err(source.error(keyword, "WorldEnd without WorldBegin"));
        }
        self.ended = true;
        Ok(())
    }

    fn include(&mut self, name: &Text, source: &Rc<Source>) -> Result<()> {
        if name.text.is_empty() {
            return Err(source.error(&name.span, "the name of the file is empty"));
        }
        let path = self.directory.join(&*name.text);
        let identity = path.canonicalize().unwrap_or_else(|_| path.clone());
        if self.reading.contains(&identity) {
            let message = format!("{} includes itself", path.display());
            return Err(source.error(&name.span, message));
        }
        if self.reading.len() >= MAX_INCLUDE_DEPTH {
            let message = format!("more than {MAX_INCLUDE_DEPTH} files include each other");
            return Err(source.error(&name.span, message));
        }
        if self.files_read >= MAX_FILES {
            return Err(source.error(&name.span, format!("the scene includes more than {MAX_FILES} files")));
        }
        let read = Source::read(&path).and_then(|included| self.read(Rc::new(included)));
        read.map_err(|error| error.note(format!("included from {}", source.at(&name.span))))
    }

    /// Camera, Film and their like belong before `WorldBegin`.
    fn check_before_world(&self, name: &str, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        if !self.in_world {
            return Ok(());
        }
        let error = source.error(keyword, format!("{name} inside the world"));
        Err(error.note("expected before WorldBegin"))
    }

    /// Geometry belongs after `WorldBegin`.
    pub(super) fn check_in_world(&self, name: &str, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        if self.in_world {
            return Ok(());
        }
        let error = source.error(keyword, format!("{name} outside the world")).note("expected after WorldBegin");
        Err(error.note("or is this file a part that another one includes?"))
    }

    fn camera(&mut self, entity: &Entity, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        self.check_before_world("Camera", keyword, source)?;
        let mut parameters = Parameters::new("Camera", entity, source);
        if let (Some((reason, place)), false) = (&self.singular, self.state.current.inverse.is_finite()) {
            return Err(place.error(*reason).note("so the camera, which comes after it, has no place"));
        }
        let camera = CameraParameters::read(&mut parameters, &self.state.current, &mut self.warnings)?;
        parameters.finish(&mut self.warnings);
        self.camera = Some(camera);
        self.state.name("camera", self.state.current.inverted());
        Ok(())
    }

    fn film(&mut self, entity: &Entity, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        self.check_before_world("Film", keyword, source)?;
        let mut parameters = Parameters::new("Film", entity, source);
        self.film = FilmParameters::read(&mut parameters)?;
        parameters.finish_with_suggestions(&mut self.warnings);
        self.film_place = Some(Place::new(source, keyword));
        Ok(())
    }

    fn shape(&mut self, entity: &Entity, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        self.check_in_world("Shape", keyword, source)?;
        let Some(number) = self.shape_count.checked_add(1) else {
            return Err(source.error(keyword, format!("the scene has more than {} shapes", u32::MAX)));
        };
        self.shape_count = number;
        let is_in_object = self.objects.open.is_some();
        let (shapes, transforms) = match &mut self.objects.open {
            Some(Definition { shapes, transforms, .. }) => (shapes, transforms),
            None => (&mut self.shapes, &mut self.transforms),
        };
        let mut target = ShapeTarget {
            shapes,
            transforms,
            warnings: &mut self.warnings,
            directory: &self.directory,
            number,
            world_from_object: self.state.current.matrix,
            is_in_object,
        };
        target.add(Parameters::new("Shape", entity, source))
    }

    /// The scene, when all has been read.
    pub(super) fn finish(self, options: &LoadOptions) -> Result<Scene> {
        if let Some(open) = self.state.innermost() {
            return Err(open.place.error(format!("{} without {}", open.block.begin(), open.block.end())));
        }
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
            summary: summary(&self.skipped),
        })
    }
}

fn summary(skipped: &BTreeMap<&'static str, u64>) -> Option<String> {
    if skipped.is_empty() {
        return None;
    }
    let counts: Vec<String> = skipped.iter().map(|(keyword, count)| format!("{count} {keyword}")).collect();
    Some(format!("skipped, without influence on hit and depth: {}", counts.join(", ")))
}
