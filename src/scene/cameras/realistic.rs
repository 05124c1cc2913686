//! `Camera "realistic"`: rendered as the pinhole camera that has its field of view (rule R11).

use super::lens_file::ThickLens;
use crate::camera::Projection;
use crate::error::{Diagnostic, Result};
use crate::input::advise_beside;
use crate::scene::inputs::Inputs;
use crate::scene::parameters::Parameters;
use crate::scene::warnings::Warnings;

/// pbrt's default distance from the film to the plane in focus, in metres.
const FOCUS_DISTANCE: f64 = 10.0;

/// The lens of a realistic camera, before the film is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RealisticLens {
    /// The distance from the principal plane to the film, in millimetres.
    image_distance: f64,
}

impl RealisticLens {
    /// Reads the parameters and the lens file, and warns of the pinhole.
    pub(super) fn read(
        parameters: &mut Parameters,
        inputs: &mut Inputs,
        warnings: &mut Warnings,
    ) -> Result<RealisticLens> {
        let focus_distance = parameters.number("focusdistance")?;
        let ignored = ["aperturediameter", "aperture", "simpleweighting", "scale"];
        parameters.ignore(&ignored);
        let lens = read_lens(parameters, inputs, warnings)?;
        if let Some(lens) = lens {
            let diagnostic = Diagnostic::new(
                "a realistic camera is rendered as the pinhole camera that has its field of view",
            );
            let note = format!(
                "a focal length of {:.1} mm; distortion and blur of the lens are left out",
                lens.focal_length
            );
            parameters.warn_at_name("realistic", diagnostic.note(note), warnings);
        }
        let lens = lens.unwrap_or(ThickLens::NORMAL);
        Ok(RealisticLens {
            image_distance: lens.image_distance(focus_distance.unwrap_or(FOCUS_DISTANCE)),
        })
    }

    /// The pinhole camera, for a film of this resolution and this diagonal in millimetres.
    pub(super) fn projection(&self, [width, height]: [u32; 2], diagonal: f64) -> Projection {
        let (longer, shorter) = (width.max(height), width.min(height));
        let ratio = f64::from(longer) / f64::from(shorter);
        let half_side = 0.5 * diagonal / (1.0 + ratio * ratio).sqrt();
        Projection::Perspective {
            tangent: half_side / self.image_distance,
        }
    }
}

/// The lens of the parameter `lensfile`. `None`, with a warning, if there is none.
fn read_lens(
    parameters: &mut Parameters,
    inputs: &mut Inputs,
    warnings: &mut Warnings,
) -> Result<Option<ThickLens>> {
    let filename = parameters.path("lensfile")?;
    let read = filename.map(|filename| {
        let path = inputs.resolve(&filename);
        inputs.add(&path);
        ThickLens::read(&path).map_err(|error| {
            let place = parameters.place_of("lensfile");
            advise_beside(&place.path, &filename, &path, error)
        })
    });
    let reason = match read {
        Some(Ok(lens)) => return Ok(Some(lens)),
        Some(Err(error)) => error.to_string(),
        None => "expected \"string lensfile\"".to_owned(),
    };
    let focal_length = ThickLens::NORMAL.focal_length;
    let message = format!(
        "the lens of this realistic camera is unknown: \
         it is rendered as a pinhole camera of {focal_length} mm"
    );
    let diagnostic = Diagnostic::new(message).note(reason);
    parameters.warn_at_name("realistic without lens", diagnostic, warnings);
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_diagonal_spans_the_field_of_view() {
        let lens = RealisticLens {
            image_distance: 50.0,
        };
        // Sides of 30 and 40 mm.
        for resolution in [[4, 3], [3, 4], [400, 300]] {
            let Projection::Perspective { tangent } = lens.projection(resolution, 50.0) else {
                panic!("a pinhole");
            };
            assert!((tangent - 15.0 / 50.0).abs() < 1e-15, "{tangent}");
        }
    }
}
