//! The `Camera` directive.

use super::realistic::RealisticLens;
use crate::camera::{Camera, Projection, ScreenWindow, SphereMapping};
use crate::error::Result;
use crate::geometry::Matrix;
use crate::scene::inputs::Inputs;
use crate::scene::parameters::{DeclaredType, Parameters};
use crate::scene::spelling;
use crate::scene::warnings::Warnings;

/// The directive, before the film is known.
#[derive(Debug, Clone)]
pub(crate) struct CameraParameters {
    world_from_camera: Matrix,
    lens: Lens,
    frame_aspect_ratio: Option<f64>,
    screen_window: Option<ScreenWindow>,
}

/// What decides how rays leave the camera.
#[derive(Debug, Clone, Copy)]
enum Lens {
    Known(Projection),
    /// Its field of view depends on the film.
    Realistic(RealisticLens),
}

/// The cameras of pbrt.
const CAMERAS: [&str; 5] = [
    "perspective",
    "orthographic",
    "environment",
    "spherical",
    "realistic",
];

impl CameraParameters {
    /// pbrt's default camera: 90 degrees, at the origin, along +z.
    pub(crate) fn default_camera() -> CameraParameters {
        CameraParameters {
            world_from_camera: Matrix::IDENTITY,
            lens: Lens::Known(Projection::Perspective { tangent: 1.0 }),
            frame_aspect_ratio: None,
            screen_window: None,
        }
    }

    /// Reads the directive of a camera at this place: the inverse of the current transform (rule
    /// R5).
    pub(crate) fn read(
        parameters: &mut Parameters,
        world_from_camera: Matrix,
        inputs: &mut Inputs,
        warnings: &mut Warnings,
    ) -> Result<CameraParameters> {
        if !world_from_camera.is_finite() {
            let message =
                "the camera's matrix is not finite: its transform is singular, or too large";
            return Err(parameters
                .error_at_name(message)
                .note("check the transforms before this directive"));
        }
        let lens = Lens::read(parameters, inputs, warnings)?;
        parameters.ignore(&["shutteropen", "shutterclose"]);
        let mut camera = CameraParameters {
            world_from_camera,
            lens,
            frame_aspect_ratio: None,
            screen_window: None,
        };
        let ignored = [
            "frameaspectratio",
            "screenwindow",
            "lensradius",
            "focaldistance",
        ];
        // pbrt reads these for every camera, and forgets them where they mean nothing.
        if !camera.has_screen_window() {
            parameters.ignore(&ignored);
            return Ok(camera);
        }
        camera.frame_aspect_ratio = frame_aspect_ratio(parameters)?;
        camera.screen_window = screen_window(parameters, warnings)?;
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
        parameters.ignore(&["focaldistance"]);
        Ok(camera)
    }

    /// Whether the camera looks through a window of its own.
    fn has_screen_window(&self) -> bool {
        match &self.lens {
            Lens::Known(projection) => projection.is_linear(),
            Lens::Realistic(_) => false,
        }
    }

    /// The camera with a film of `resolution`, whose diagonal is that many millimetres.
    pub(crate) fn resolve(self, resolution: [u32; 2], diagonal: f64) -> Camera {
        let projection = match &self.lens {
            Lens::Known(projection) => *projection,
            Lens::Realistic(lens) => lens.projection(resolution, diagonal),
        };
        let aspect = self
            .frame_aspect_ratio
            .unwrap_or(f64::from(resolution[0]) / f64::from(resolution[1]));
        Camera {
            world_from_camera: self.world_from_camera,
            projection,
            screen_window: self
                .screen_window
                .unwrap_or_else(|| ScreenWindow::of_aspect(aspect)),
            resolution,
        }
    }
}

impl Lens {
    fn read(
        parameters: &mut Parameters,
        inputs: &mut Inputs,
        warnings: &mut Warnings,
    ) -> Result<Lens> {
        Ok(match parameters.entity_name() {
            "perspective" => Lens::Known(Projection::perspective(field_of_view(parameters)?)),
            "orthographic" => Lens::Known(Projection::Orthographic),
            "environment" => Lens::Known(Projection::Spherical(SphereMapping::Equirectangular)),
            "spherical" => Lens::Known(Projection::Spherical(sphere_mapping(parameters)?)),
            "realistic" => Lens::Realistic(RealisticLens::read(parameters, inputs, warnings)?),
            other => {
                let message = format!("the camera `{other}` is not supported");
                let error = parameters.error_at_name(message);
                return Err(match spelling::closest(other, CAMERAS.into_iter()) {
                    Some(known) => error.note(format!("did you mean `{known}`?")),
                    None => error
                        .note(format!("expected one of {}", CAMERAS.join(", ")))
                        .note("the closest is a perspective camera"),
                });
            }
        })
    }
}

/// The mapping of pbrt-v4's spherical camera.
fn sphere_mapping(parameters: &mut Parameters) -> Result<SphereMapping> {
    let Some(name) = parameters.string("mapping")? else {
        return Ok(SphereMapping::EqualArea);
    };
    let mut known = SphereMapping::ALL.into_iter();
    known.find(|mapping| mapping.name() == name).ok_or_else(|| {
        let error = parameters.error_at("mapping", format!("the mapping `{name}` is unknown"));
        error.note("expected \"equalarea\" or \"equirectangular\"")
    })
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
