//! Builds a scene from directives.

use super::blocks::Block;
use super::entities::Entities;
use super::graphics_state::GraphicsState;
use super::materials::{Material, Materials};
use super::objects::Objects;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::scene::census::Census;
use crate::scene::inputs::Inputs;
use crate::scene::listed::MAX_LISTED;
use crate::scene::locations::Locations;
use crate::scene::parameters::Parameters;
use crate::scene::parser::{Directive, Entity, KEYWORDS, Legal, Statement, Text};
use crate::scene::shapes::{self, AlphaTarget, ShapeTarget};
use crate::scene::source_span::SourceSpan;
use crate::scene::warnings::Warnings;
use crate::scene::{LoadOptions, Scene};
use std::path::Path;

/// A scene under construction.
pub(super) struct SceneBuilder {
    options: LoadOptions,
    phase: Phase,
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
pub(super) enum Phase {
    /// Before `WorldBegin`.
    Options,
    /// After `WorldBegin`.
    World,
    /// After `WorldEnd`.
    Ended,
}

impl SceneBuilder {
    pub(super) fn new(options: &LoadOptions) -> SceneBuilder {
        SceneBuilder {
            options: *options,
            phase: Phase::Options,
            state: GraphicsState::new(options),
            entities: Entities::default(),
            objects: Objects::default(),
            materials: Materials::default(),
            shape_count: 0,
            census: Census::default(),
            locations: options.locations.then(Locations::default),
            warnings: Warnings::default(),
        }
    }

    pub(super) fn phase(&self) -> Phase {
        self.phase
    }

    /// Lets go of the piece of the text that has been read.
    pub(super) fn settle(&mut self) {
        self.state.settle();
        self.objects.settle();
    }

    /// Counts a directive that is about to be executed.
    pub(super) fn count(&mut self, directive: &Directive) {
        self.census.count(directive);
    }

    /// Warns of a directive after `WorldEnd`.
    pub(super) fn warn_of_the_rest(&mut self, at: &SourceSpan) {
        let message = "what follows WorldEnd is ignored: one world is one picture";
        self.warnings
            .add("after the world", || at.diagnostic(message));
    }

    /// Starts an import: changes of the graphics state and names of coordinate systems end with the
    /// file; objects and materials stay. Returns whether an object is being defined.
    pub(super) fn begin_import(&mut self, keyword: &SourceSpan) -> bool {
        self.state.begin(Block::Import, keyword);
        self.objects.is_open()
    }

    /// Ends an import, and the object that its file has left open.
    pub(super) fn end_import(&mut self, was_in_object: bool) {
        self.state.close_blocks(&mut self.warnings);
        if !was_in_object {
            self.objects.end(&mut self.warnings);
        }
        self.state.end_import();
    }

    /// Executes any directive but `Include` and `Import`.
    pub(super) fn execute(
        &mut self,
        directive: &Directive,
        keyword: &SourceSpan,
        inputs: &mut Inputs,
    ) -> Result<()> {
        let (state, warnings) = (&mut self.state, &mut self.warnings);
        let whole = || keyword.beside(&directive.span);
        match &directive.statement {
            Statement::Transform(by) => state.transform.apply(by, &whole(), warnings),
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
                let (entities, transform) = (&mut self.entities, &mut state.transform);
                entities.set_camera(entity, keyword, transform, inputs, warnings)?;
            }
            Statement::Film(entity) => self.entities.set_film(entity, keyword, warnings)?,
            Statement::Accelerator(entity) => {
                self.entities.set_accelerator(entity, keyword, warnings)?;
            }
            Statement::ObjectInstance(name) => self.instance(name, keyword)?,
            Statement::Texture(texture) => state.textures.define(texture, &whole()),
            Statement::Shape(entity) => self.shape(entity, keyword, inputs)?,
            Statement::Unknown(name) => warnings.add_unknown_directive(name, keyword),
            Statement::Include(_) | Statement::Import(_) | Statement::Skipped => {}
        }
        Ok(())
    }

    /// # Errors
    /// A directive on the wrong side of `WorldBegin`.
    pub(super) fn check_legal(&self, directive: &Directive, keyword: &SourceSpan) -> Result<()> {
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

    fn instance(&mut self, name: &Text, keyword: &SourceSpan) -> Result<()> {
        if self.objects.is_open() {
            let error = keyword.error("an instance within an object");
            return Err(error.note("expected ObjectInstance after ObjectEnd: objects do not nest"));
        }
        self.state
            .transform
            .check_usable("ObjectInstance", keyword)?;
        let transform = &self.state.transform;
        transform.warn_if_moving("instance", keyword, &mut self.warnings);
        let world_from_instance = transform.matrix();
        self.objects
            .add_instance(name, keyword, world_from_instance, &mut self.warnings)?;
        self.state.transform.record_instance();
        if let Some(locations) = &mut self.locations {
            locations.add_instance(keyword);
        }
        Ok(())
    }

    fn shape(&mut self, entity: &Entity, keyword: &SourceSpan, inputs: &mut Inputs) -> Result<()> {
        let number = self.next_shape(entity, keyword)?;
        let name = &entity.name.text;
        let is_light = self.state.is_light;
        let bounds_medium = self.state.material.only_bounds_media(is_light);
        if bounds_medium {
            self.census.add_boundary(name, || keyword.place());
        } else if shapes::is_supported(name) {
            let transform = &self.state.transform;
            transform.check_usable("Shape", keyword)?;
            transform.warn_if_moving("shape", keyword, &mut self.warnings);
        }
        self.materials.wait(&self.state.material, number, is_light);
        let world_from_object = self.state.transform.matrix();
        let reverses_orientation = self.state.reverses_orientation;
        let is_turned = reverses_orientation != world_from_object.swaps_handedness();
        let is_in_object = self.objects.is_open();
        let store = self.objects.store();
        let mut target = ShapeTarget {
            geometry: &mut store.geometry,
            transforms: &mut store.transforms,
            warnings: &mut self.warnings,
            inputs,
            options: &self.options,
            number,
            world_from_object,
            is_in_object,
            reverses_orientation,
            is_turned,
            bounds_medium,
            keeps_uv: self.options.uv,
            alpha: AlphaTarget::new(&self.state.textures),
        };
        let before = target.geometry.own_count();
        let parameters = Parameters::of_shape(entity, keyword.file(), &self.state.defaults)?;
        let is_added = shapes::add(parameters, &mut target)?;
        let added = target.geometry.own_count() - before;
        if target.alpha.is_hidden {
            self.census.add_hidden(name, || keyword.place());
        }
        if let Some(used) = target.alpha.new_texture {
            self.census.add_texture(used.name(), || used.at().place());
        }
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
            let (matrix, is_light) = (self.state.transform.matrix(), self.state.is_light);
            locations.add_shape(&entity.name.text, keyword, &matrix, is_light);
        }
        Ok(number)
    }

    /// The file name of the film.
    pub(super) fn into_film_filename(self) -> Option<String> {
        self.entities.into_film_filename()
    }

    /// The scene of the file `path`, once all directives have been executed.
    pub(super) fn finish(mut self, path: &Path) -> Result<Scene> {
        self.state.close_blocks(&mut self.warnings);
        self.objects.end(&mut self.warnings);
        self.objects.define_awaited()?;
        self.objects.hide(&self.materials.late_boundaries());
        self.census.set_unused(self.objects.unused(MAX_LISTED));
        if self.phase == Phase::Options {
            let diagnostic = Diagnostic::new("the scene has no WorldBegin")
                .at(SourceLocation::file(path))
                .note("expected Camera and Film, WorldBegin, and then the shapes");
            return Err(Error::bad_input(diagnostic));
        }
        let (camera, film, accelerator) = self.entities.resolve(path, self.options.resolution)?;
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
