//! The directives that have a type and parameters, but for `Shape`.

use super::accelerator::AcceleratorParameters;
use super::builder::Builder;
use super::camera_parameters::CameraParameters;
use super::film::FilmParameters;
use super::name::Name;
use super::parameters::Parameters;
use super::parser::{Entity, Span};
use super::shape_defaults::MAX_DEFAULTS;
use super::source::{Place, Source};
use super::spelling;
use crate::error::{Diagnostic, Result};
use std::rc::Rc;
use std::sync::Arc;

/// What pbrt-v4's `Attribute` can set defaults for.
const TARGETS: [&str; 5] = ["shape", "light", "material", "medium", "texture"];

impl Builder<'_> {
    /// Camera, Film and their like belong before `WorldBegin`.
    fn check_before_world(&self, name: &str, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        if !self.in_world {
            return Ok(());
        }
        let error = source.error(keyword, format!("{name} inside the world"));
        Err(error.note("expected before WorldBegin"))
    }

    pub(super) fn camera(
        &mut self,
        entity: &Entity,
        keyword: &Span,
        source: &Rc<Source>,
    ) -> Result<()> {
        self.check_before_world("Camera", keyword, source)?;
        let mut parameters = Parameters::new("Camera", entity, source)?;
        self.check_usable("Camera", keyword, source)?;
        if let (Some((reason, place)), false) =
            (&self.singular, self.state.current.inverse.is_finite())
        {
            return Err(place
                .error(*reason)
                .note("so the camera, which comes after it, has no place"));
        }
        let camera =
            CameraParameters::read(&mut parameters, &self.state.current, &mut self.warnings)?;
        parameters.finish(&mut self.warnings);
        self.camera = Some(camera);
        if let (Some(roundings), Some(rounded)) = (&mut self.roundings, &self.state.rounded) {
            roundings.camera = Arc::clone(rounded);
        }
        self.state.name_inverse(Name::from("camera"));
        if self.state.is_moving() {
            let message =
                "a moving camera is not supported: it stands where it is at the start time";
            self.warnings.add("moving camera", || {
                Diagnostic::new(message).at(source.at(keyword))
            });
        }
        Ok(())
    }

    pub(super) fn film(
        &mut self,
        entity: &Entity,
        keyword: &Span,
        source: &Rc<Source>,
    ) -> Result<()> {
        self.check_before_world("Film", keyword, source)?;
        let mut parameters = Parameters::new("Film", entity, source)?;
        self.film = FilmParameters::read(&mut parameters, &mut self.warnings)?;
        parameters.finish_with_suggestions(&mut self.warnings);
        self.film_place = Some(Place::new(source, keyword));
        Ok(())
    }

    pub(super) fn accelerator(&mut self, entity: &Entity, source: &Rc<Source>) -> Result<()> {
        let mut parameters = Parameters::new("Accelerator", entity, source)?;
        self.accelerator = AcceleratorParameters::read(&mut parameters)?;
        parameters.finish_with_suggestions(&mut self.warnings);
        Ok(())
    }

    pub(super) fn make_material(&mut self, entity: &Entity, source: &Rc<Source>) {
        if !self.materials.make(entity) {
            self.warnings.add("material without type", || {
                let message = "a named material without `\"string type\"`: shapes under it only bound a medium";
                let diagnostic = Diagnostic::new(message).at(source.at(&entity.name.span));
                diagnostic.note("pbrt-v3 reads it so; pbrt-v4 refuses it")
            });
        }
    }

    /// Of the defaults that v4 can set, only those of shapes matter.
    pub(super) fn attribute(&mut self, entity: &Entity, source: &Rc<Source>) -> Result<()> {
        let target = Parameters::new("Attribute", entity, source)?.entity_name();
        if target == "shape" {
            if !self.state.defaults.add(&entity.parameters, source) {
                let message = format!(
                    "more than {MAX_DEFAULTS} parameters of shapes are set by Attribute at a time"
                );
                return Err(source.error(&entity.name.span, message));
            }
        } else if !TARGETS.contains(&target) {
            let error = source.error(
                &entity.name.span,
                format!("Attribute sets nothing for `{target}`"),
            );
            return Err(match spelling::closest(target, TARGETS.into_iter()) {
                Some(known) => error.note(format!("did you mean `{known}`?")),
                None => error.note(format!("expected one of {}", TARGETS.join(", "))),
            });
        }
        Ok(())
    }
}
