//! The `Film` directive: resolution, crop, name.

use super::parameters::{DeclaredType, Parameters};
use super::warnings::Warnings;
use crate::error::{Diagnostic, Result};
use crate::film::PixelBounds;
use crate::terminal_text::is_command;

/// The default width of a film.
const WIDTH: u32 = 1280;
/// The default height.
const HEIGHT: u32 = 720;

/// The pixels of the image, and those that the scene asks for.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// Width and height of the whole film in pixels.
    pub resolution: [u32; 2],
    /// The pixels that the scene asks for; the whole film without a crop.
    pub crop: PixelBounds,
    /// The file name of the image.
    pub filename: Option<String>,
}

/// pbrt's default diagonal of a film in millimetres.
const DIAGONAL: f64 = 35.0;

/// The directive, before the command line may override its resolution.
#[derive(Debug, Clone, Default)]
pub(super) struct FilmParameters {
    x_resolution: Option<u32>,
    y_resolution: Option<u32>,
    crop_window: Option<[f64; 4]>,
    pixel_bounds: Option<PixelBounds>,
    pub(super) filename: Option<String>,
    diagonal: Option<f64>,
}

impl FilmParameters {
    /// The diagonal of the film in millimetres: only realistic cameras depend on it.
    pub(super) fn diagonal(&self) -> f64 {
        self.diagonal.unwrap_or(DIAGONAL)
    }

    pub(super) fn read(
        parameters: &mut Parameters,
        warnings: &mut Warnings,
    ) -> Result<FilmParameters> {
        let most = PixelBounds::MAX_SIDE.into();
        let x_resolution = parameters
            .integer("xresolution", 1, most)?
            .map(|x| x as u32);
        let y_resolution = parameters
            .integer("yresolution", 1, most)?
            .map(|y| y as u32);
        let crop_window = crop_window(parameters, warnings)?;
        let size = [
            x_resolution.unwrap_or(WIDTH),
            y_resolution.unwrap_or(HEIGHT),
        ];
        let pixel_bounds = pixel_bounds(parameters, size, warnings)?;
        if crop_window.is_some() && pixel_bounds.is_some() {
            let message = "both `cropwindow` and `pixelbounds` are set: \
                           the crop window counts, as in pbrt-v4";
            parameters.warn("pixelbounds", message, warnings);
        }
        let filename = parameters.string("filename")?.map(str::to_owned);
        if filename
            .as_deref()
            .is_some_and(|name| name.chars().any(is_command))
        {
            let error = parameters.error_at("filename", "`filename` contains control characters");
            return Err(error.note("expected the name of a file, such as \"image.exr\""));
        }
        let diagonal = parameters.unchecked_number("diagonal");
        Ok(FilmParameters {
            x_resolution,
            y_resolution,
            crop_window,
            pixel_bounds,
            filename,
            diagonal: diagonal.filter(|diagonal| *diagonal > 0.0 && diagonal.is_finite()),
        })
    }

    /// The film, 1280 x 720 by default. `resolution` overrides the scene's.
    ///
    /// # Errors
    /// A crop without pixels.
    pub(super) fn resolve(self, resolution: Option<[u32; 2]>) -> std::result::Result<Film, String> {
        let from_scene = [
            self.x_resolution.unwrap_or(WIDTH),
            self.y_resolution.unwrap_or(HEIGHT),
        ];
        let resolution = resolution.unwrap_or(from_scene);
        let whole = PixelBounds::of_film(resolution[0], resolution[1]);
        let crop = match (self.crop_window, self.pixel_bounds) {
            (Some(window), _) => PixelBounds::of_crop_window(window, resolution),
            (None, Some(bounds)) => bounds.intersection(&whole),
            (None, None) => whole,
        };
        if crop.is_empty() {
            return Err("the crop of the film has no pixel".to_owned());
        }
        Ok(Film {
            resolution,
            crop,
            filename: self.filename,
        })
    }
}

/// The crop window in fractions of the film, clamped to it as in pbrt.
fn crop_window(parameters: &mut Parameters, warnings: &mut Warnings) -> Result<Option<[f64; 4]>> {
    let Some(window) = parameters.fixed_numbers::<4>("cropwindow", DeclaredType::FLOAT)? else {
        return Ok(None);
    };
    if window.iter().any(|fraction| fraction.is_nan()) {
        let error = parameters.error_at(
            "cropwindow",
            "`cropwindow` takes fractions of the film, from 0 to 1",
        );
        return Err(error.note("expected x0 x1 y0 y1; `pixelbounds` takes pixels"));
    }
    let clamped = window.map(|fraction| fraction.clamp(0.0, 1.0));
    if clamped != window {
        let [x0, x1, y0, y1] = clamped;
        let message = format!("`cropwindow` reaches beyond the film: read as {x0} {x1} {y0} {y1}");
        let diagnostic = Diagnostic::new(message).at(parameters.place_of("cropwindow"));
        let note =
            "expected fractions of the film from 0 to 1: x0 x1 y0 y1; `pixelbounds` takes pixels";
        warnings.add("cropwindow beyond the film", || diagnostic.note(note));
    }
    Ok(Some(clamped))
}

/// The pixels that the scene asks for, ends in order as in pbrt-v4, clamped to its film of `size`.
fn pixel_bounds(
    parameters: &mut Parameters,
    size: [u32; 2],
    warnings: &mut Warnings,
) -> Result<Option<PixelBounds>> {
    let Some(bounds) = parameters.fixed_numbers::<4>("pixelbounds", DeclaredType::INTEGER)? else {
        return Ok(None);
    };
    if bounds
        .iter()
        .any(|bound| bound.fract() != 0.0 || !bound.is_finite())
    {
        return Err(parameters.error_at(
            "pixelbounds",
            "`pixelbounds` takes four integers: x0 x1 y0 y1",
        ));
    }
    let [width, height] = size.map(f64::from);
    if bounds
        .into_iter()
        .zip([width, width, height, height])
        .any(|(bound, most)| !(0.0..=most).contains(&bound))
    {
        let message = format!(
            "`pixelbounds` reaches beyond the film of {width} x {height} pixels: cut off at its edges"
        );
        let diagnostic = Diagnostic::new(message).at(parameters.place_of("pixelbounds"));
        warnings.add("pixelbounds beyond the film", || {
            diagnostic.note("expected pixels of the film: x0 x1 y0 y1")
        });
    }
    // The conversion clamps to 0; the size of the film clamps the rest.
    let [x0, x1, y0, y1] = bounds.map(|bound| bound as u32);
    Ok(Some(PixelBounds {
        x0: x0.min(x1),
        x1: x0.max(x1),
        y0: y0.min(y1),
        y1: y0.max(y1),
    }))
}
