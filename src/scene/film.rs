//! The `Film` directive: resolution, crop, name.

use super::declared_type::DeclaredType;
use super::parameters::Parameters;
use crate::error::Result;
use crate::film::PixelBounds;
use crate::terminal_text::is_command;

/// Which pixels there are and which are wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// Width and height of the whole film in pixels.
    pub resolution: [u32; 2],
    /// The pixels that the scene asks for; the whole film without a crop.
    pub crop: PixelBounds,
    /// Where the scene wants the picture.
    pub filename: Option<String>,
}

/// What the directive says, before the command line has its say on the resolution.
#[derive(Debug, Clone, Default)]
pub(super) struct FilmParameters {
    x_resolution: Option<u32>,
    y_resolution: Option<u32>,
    crop_window: Option<[f64; 4]>,
    pixel_bounds: Option<[u32; 4]>,
    pub(super) filename: Option<String>,
}

impl FilmParameters {
    pub(super) fn read(parameters: &mut Parameters) -> Result<FilmParameters> {
        let most = PixelBounds::MAX_SIDE.into();
        let x_resolution = parameters.integer("xresolution", 1, most)?.map(|x| x as u32);
        let y_resolution = parameters.integer("yresolution", 1, most)?.map(|y| y as u32);
        let crop_window = parameters.fixed_numbers::<4>("cropwindow", DeclaredType::FLOAT)?;
        if crop_window.is_some_and(|window| !window.iter().all(|fraction| (0.0..=1.0).contains(fraction))) {
            let error = parameters.error_at("cropwindow", "`cropwindow` takes fractions of the film, from 0 to 1");
            return Err(error.note("expected x0 x1 y0 y1; `pixelbounds` takes pixels"));
        }
        let pixel_bounds = parameters.fixed_numbers::<4>("pixelbounds", DeclaredType::INTEGER)?;
        if pixel_bounds.is_some_and(|bounds| bounds.iter().any(|bound| bound.fract() != 0.0 || !bound.is_finite())) {
            return Err(parameters.error_at("pixelbounds", "`pixelbounds` takes four integers: x0 x1 y0 y1"));
        }
        // Bounds beyond the film are cut off at its edges, as in pbrt.
        let pixel_bounds = pixel_bounds.map(|bounds| bounds.map(|bound| bound as u32));
        let filename = parameters.string("filename")?.map(str::to_owned);
        if filename.as_deref().is_some_and(|name| name.chars().any(is_command)) {
            let error =
                parameters.error_at("filename", "`filename` holds control characters, which no image is named by");
            return Err(error.note("expected the name of a file, such as \"image.exr\""));
        }
        Ok(FilmParameters { x_resolution, y_resolution, crop_window, pixel_bounds, filename })
    }

    /// The film, 1280 x 720 by default, with `resolution` in place of the scene's.
    ///
    /// # Errors
    /// The crop, where it has no pixel.
    pub(super) fn resolve(self, resolution: Option<[u32; 2]>) -> std::result::Result<Film, String> {
        let from_scene = [self.x_resolution.unwrap_or(1280), self.y_resolution.unwrap_or(720)];
        let resolution = resolution.unwrap_or(from_scene);
        let whole = PixelBounds::of_film(resolution[0], resolution[1]);
        let crop = match (self.pixel_bounds, self.crop_window) {
            (Some([x0, x1, y0, y1]), _) => PixelBounds { x0, x1, y0, y1 }.intersection(&whole),
            (None, Some(window)) => PixelBounds::of_crop_window(window, resolution),
            (None, None) => whole,
        };
        if crop.is_empty() {
            return Err("the crop of the film has no pixel".to_owned());
        }
        Ok(Film { resolution, crop, filename: self.filename })
    }
}
