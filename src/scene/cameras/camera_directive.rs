//! The `Camera` directive.

use crate::camera::{Camera, Projection, ScreenWindow};
use crate::error::Result;
use crate::geometry::{Matrix, Transform};
use crate::scene::parameters::{DeclaredType, Parameters};
use crate::scene::spelling;
use crate::scene::warnings::Warnings;

/// The directive, before the film is known.
#[derive(Debug, Clone)]
pub(crate) struct CameraParameters {
    world_from_camera: Matrix,
    projection: Projection,
    frame_aspect_ratio: Option<f64>,
    screen_window: Option<ScreenWindow>,
}

impl CameraParameters {
    /// pbrt's default camera: 90 degrees, at the origin, along +z.
    pub(crate) fn default_camera() -> CameraParameters {
        CameraParameters {
            world_from_camera: Matrix::IDENTITY,
            projection: Projection::Perspective { tangent: 1.0 },
            frame_aspect_ratio: None,
            screen_window: None,
        }
    }

    /// Reads the directive. `current` is the current transform: camera space from world space (rule
    /// R5).
    pub(crate) fn read(
        parameters: &mut Parameters,
        current: &Transform,
        warnings: &mut Warnings,
    ) -> Result<CameraParameters> {
        let world_from_camera = current.inverse;
        if !world_from_camera.is_finite() {
            let message =
                "the camera's matrix is not finite: its transform is singular, or too large";
            return Err(parameters
                .error_at_name(message)
                .note("check the transforms before this directive"));
        }
        let projection = match parameters.entity_name() {
            "perspective" => Projection::perspective(field_of_view(parameters)?),
            "orthographic" => Projection::Orthographic,
            other => {
                let message = format!("the camera `{other}` is not supported");
                let error = parameters.error_at_name(message);
                return Err(
                    match spelling::closest(other, ["perspective", "orthographic"].into_iter()) {
                        Some(known) => error.note(format!("did you mean `{known}`?")),
                        None => error
                            .note("expected \"perspective\" or \"orthographic\"")
                            .note(closest_camera(other)),
                    },
                );
            }
        };
        let frame_aspect_ratio = frame_aspect_ratio(parameters)?;
        let screen_window = screen_window(parameters, warnings)?;
        if parameters
            .number("lensradius")?
            .is_some_and(|radius| radius != 0.0)
        {
            parameters.warn(
                "lensradius",
                "the lens radius is ignored: every ray starts at one point",
                warnings,
            );
        }
        parameters.ignore(&["focaldistance", "shutteropen", "shutterclose"]);
        Ok(CameraParameters {
            world_from_camera,
            projection,
            frame_aspect_ratio,
            screen_window,
        })
    }

    /// The camera with a film of `resolution`.
    pub(crate) fn resolve(self, resolution: [u32; 2]) -> Camera {
        let aspect = self
            .frame_aspect_ratio
            .unwrap_or(f64::from(resolution[0]) / f64::from(resolution[1]));
        Camera {
            world_from_camera: self.world_from_camera,
            projection: self.projection,
            screen_window: self
                .screen_window
                .unwrap_or_else(|| ScreenWindow::of_aspect(aspect)),
            resolution,
        }
    }
}

/// Names the supported camera that is closest to `name`.
fn closest_camera(name: &str) -> &'static str {
    match name {
        "environment" | "spherical" => {
            "the closest are several perspective cameras that look around, \
             each less than 180 degrees wide (--cameras)"
        }
        "realistic" => "the closest is a perspective camera with the field of view of the lens",
        _ => "the closest is a perspective camera",
    }
}

/// The screen window, four finite numbers. A reversed window mirrors the picture. A window without
/// extent repeats a row or column: that is a warning.
fn screen_window(
    parameters: &mut Parameters,
    warnings: &mut Warnings,
) -> Result<Option<ScreenWindow>> {
    let Some([x0, x1, y0, y1]) =
        parameters.fixed_numbers::<4>("screenwindow", DeclaredType::FLOAT)?
    else {
        return Ok(None);
    };
    if [x0, x1, y0, y1].iter().any(|number| !number.is_finite()) {
        let error = parameters.error_at("screenwindow", "the screen window is not finite");
        return Err(error.note("expected x0 x1 y0 y1 with x0 < x1 and y0 < y1"));
    }
    if x0 == x1 || y0 == y1 {
        let message =
            "the screen window has no extent: all pixels of a row or a column look the same way";
        parameters.warn("screenwindow", message, warnings);
    }
    Ok(Some(ScreenWindow { x0, x1, y0, y1 }))
}

/// The field of view in degrees. pbrt's `halffov` is half of it, and overrides `fov` if it is above
/// 0.
fn field_of_view(parameters: &mut Parameters) -> Result<f64> {
    let fov = parameters.number("fov")?;
    let half = parameters.number("halffov")?.filter(|half| *half > 0.0);
    let (name, fov) = match (half, fov) {
        (Some(half), _) => ("halffov", 2.0 * half),
        (None, Some(fov)) => ("fov", fov),
        (None, None) => return Ok(90.0),
    };
    if fov > 0.0 && fov < 180.0 {
        return Ok(fov);
    }
    let error = parameters.error_at(name, format!("a field of view of {fov} degrees"));
    Err(error.note("expected more than 0 and less than 180 degrees"))
}

fn frame_aspect_ratio(parameters: &mut Parameters) -> Result<Option<f64>> {
    match parameters.number("frameaspectratio")? {
        Some(ratio) if !(ratio > 0.0 && ratio.is_finite()) => {
            let message = format!("`frameaspectratio` is {ratio}, expected a number above 0");
            Err(parameters.error_at("frameaspectratio", message))
        }
        ratio => Ok(ratio),
    }
}
