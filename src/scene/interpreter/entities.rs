//! The camera, film and accelerator of a scene.

use super::current_transform::CurrentTransform;
use crate::camera::Camera;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::scene::accelerator::AcceleratorParameters;
use crate::scene::cameras::CameraParameters;
use crate::scene::film::{Film, FilmParameters};
use crate::scene::inputs::Inputs;
use crate::scene::parameters::Parameters;
use crate::scene::parser::Entity;
use crate::scene::source_span::SourceSpan;
use crate::scene::warnings::Warnings;
use std::path::Path;

/// The last camera, film and accelerator that the scene describes.
#[derive(Default)]
pub(super) struct Entities {
    camera: Option<CameraParameters>,
    film: FilmParameters,
    film_at: Option<SourceSpan>,
    accelerator: AcceleratorParameters,
}

impl Entities {
    pub(super) fn set_camera(
        &mut self,
        entity: &Entity,
        at: &SourceSpan,
        transform: &mut CurrentTransform,
        inputs: &mut Inputs,
        warnings: &mut Warnings,
    ) -> Result<()> {
        let mut parameters = Parameters::new("Camera", entity, at.file())?;
        transform.check_usable("Camera", at)?;
        transform.check_invertible()?;
        let world_from_camera = transform.inverse();
        let camera = CameraParameters::read(&mut parameters, world_from_camera, inputs, warnings)?;
        parameters.finish(warnings);
        self.camera = Some(camera);
        transform.set_camera();
        transform.warn_if_moving("camera", at, warnings);
        Ok(())
    }

    pub(super) fn set_film(
        &mut self,
        entity: &Entity,
        at: &SourceSpan,
        warnings: &mut Warnings,
    ) -> Result<()> {
        let mut parameters = Parameters::new("Film", entity, at.file())?;
        self.film = FilmParameters::read(&mut parameters, warnings)?;
        parameters.finish_with_suggestions(warnings);
        self.film_at = Some(at.kept());
        Ok(())
    }

    pub(super) fn set_accelerator(
        &mut self,
        entity: &Entity,
        at: &SourceSpan,
        warnings: &mut Warnings,
    ) -> Result<()> {
        let mut parameters = Parameters::new("Accelerator", entity, at.file())?;
        self.accelerator = AcceleratorParameters::read(&mut parameters)?;
        parameters.finish_with_suggestions(warnings);
        Ok(())
    }

    /// The file name of the film.
    pub(super) fn into_film_filename(self) -> Option<String> {
        self.film.filename
    }

    /// Camera, film and accelerator of the scene `path`. `resolution` overrides the film's.
    ///
    /// # Errors
    /// A film whose crop has no pixel.
    pub(super) fn resolve(
        self,
        path: &Path,
        resolution: Option<[u32; 2]>,
    ) -> Result<(Camera, Film, AcceleratorParameters)> {
        let diagonal = self.film.diagonal();
        let film = self
            .film
            .resolve(resolution)
            .map_err(|message| match &self.film_at {
                Some(at) => at.error(message),
                None => Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(path))),
            })?;
        let camera = self.camera.unwrap_or_else(CameraParameters::default_camera);
        let camera = camera.resolve(film.resolution, diagonal);
        Ok((camera, film, self.accelerator))
    }
}
