//! Lists of cameras in JSON files, to see one scene from many places.
//!
//! The file is a list of objects. Each places its camera as pbrt or as computer vision does:
//!
//! ```json
//! [
//!     {"name": "front", "lookat": [0, 0, -3,  0, 0, 0,  0, 1, 0], "fov": 60},
//!     {"name": "moved", "transform": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 3, 1]},
//!     {"name": "real", "K": [[500, 0, 319.5], [0, 500, 239.5], [0, 0, 1]],
//!      "R": [[1, 0, 0], [0, -1, 0], [0, 0, -1]], "t": [0, 0, 3], "resolution": [640, 480]}
//! ]
//! ```
//!
//! `lookat` and `transform` are the numbers of the directives `LookAt` and `Transform` before a
//! `Camera`. Film and lens are then the scene's; `fov` overrides its field of view.

use super::intrinsics::{self, Intrinsics, Refusal};
use super::json;
use super::scalar::Scalar;
use crate::camera::{Camera, Projection};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::{Matrix, Point, Transform, Vector};
use crate::input;
use crate::scene::{Film, Scene};
use crate::terminal_text::is_command;
use serde::Deserialize;
use std::collections::HashSet;
use std::path::Path;

/// The most cameras in a file.
const MAX_POSES: usize = 1_000_000;

/// The longest name in bytes: it becomes part of a file name.
const MAX_NAME: usize = 100;

/// One camera of the list.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    name: String,
    camera_from_world: Transform,
    lens: Lens,
}

/// Where the film and the field of view come from.
#[derive(Debug, Clone, PartialEq)]
enum Lens {
    /// The scene's; `fov`, in degrees, overrides its field of view.
    OfScene { fov: Option<f64> },
    /// A calibrated camera's.
    Calibrated(Intrinsics),
}

/// One camera as it stands in the file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: Option<String>,
    lookat: Option<[f64; 9]>,
    transform: Option<[f64; 16]>,
    fov: Option<f64>,
    #[serde(rename = "K")]
    k: Option<[[f64; 3]; 3]>,
    #[serde(rename = "R")]
    r: Option<[[f64; 3]; 3]>,
    t: Option<[Scalar; 3]>,
    resolution: Option<[u32; 2]>,
}

/// Reads the list of cameras in the file `path`.
///
/// # Errors
/// A file that cannot be read or is not such a list, a camera that sees nothing, or a name that
/// occurs twice.
pub fn read_poses(path: &Path) -> Result<Vec<Pose>> {
    parse_poses(path, &input::read(path)?)
}

/// Reads the list of cameras in `bytes`, the content of the file `path`.
///
/// # Errors
/// See [`read_poses`].
pub fn parse_poses(path: &Path, bytes: &[u8]) -> Result<Vec<Pose>> {
    let entries: Vec<Entry> = json::list(path, bytes)?;
    let refuse = |found: String| {
        let diagnostic = Diagnostic::new(found).at(SourceLocation::file(path));
        Error::bad_input(diagnostic)
    };
    if entries.is_empty() || entries.len() > MAX_POSES {
        return Err(refuse(format!("a list of {} cameras", entries.len()))
            .note(format!("expected 1 to {MAX_POSES}")));
    }
    let mut names = HashSet::new();
    let mut poses = Vec::with_capacity(entries.len());
    for (place, entry) in entries.into_iter().enumerate() {
        let number = place + 1;
        let name = entry.name.clone().unwrap_or_else(|| number.to_string());
        let pose = check_name(&name).and_then(|()| entry.pose(name.clone()));
        let pose = pose.map_err(|(found, expected)| {
            refuse(format!("camera {number} of the list, `{name}`: {found}"))
                .note(format!("expected {expected}"))
        })?;
        if !names.insert(pose.name.clone()) {
            return Err(refuse(format!("two cameras are called `{name}`"))
                .note("expected a name of its own for each"));
        }
        poses.push(pose);
    }
    Ok(poses)
}

fn check_name(name: &str) -> std::result::Result<(), Refusal> {
    let is_bad = |c: char| is_command(c) || "/\\:*?\"<>|{}".contains(c);
    if name.is_empty() || name.len() > MAX_NAME || name.starts_with('.') || name.chars().any(is_bad)
    {
        let expected = format!("a part of a file name, of at most {MAX_NAME} bytes");
        return Err((
            "the name cannot be part of a file name".to_owned(),
            expected,
        ));
    }
    Ok(())
}

impl Entry {
    fn pose(self, name: String) -> std::result::Result<Pose, Refusal> {
        let refusal = |found: &str, expected: &str| (found.to_owned(), expected.to_owned());
        let (camera_from_world, lens) = match (self.lookat, self.transform, self.k, self.r, self.t)
        {
            (Some(numbers), None, None, None, None) => (look_at(&numbers)?, self.lens_of_scene()?),
            (None, Some(numbers), None, None, None) => {
                let transform = Transform::from_column_major(&numbers);
                let expected = "16 numbers as `Transform` takes them: \
                                the 4th, 8th and 12th are 0, the last is not";
                (
                    transform.ok_or_else(|| refusal("a transform that is not affine", expected))?,
                    self.lens_of_scene()?,
                )
            }
            (None, None, Some(k), Some(r), Some(t)) => {
                if self.fov.is_some() {
                    return Err(refusal(
                        "both `fov` and `K`",
                        "`K` alone: it decides the field of view",
                    ));
                }
                (
                    intrinsics::camera_from_world(&r, &t.map(|Scalar(number)| number))?,
                    Lens::Calibrated(Intrinsics::new(&k, self.resolution)?),
                )
            }
            _ => {
                return Err(refusal(
                    "no single place for the camera",
                    "one of `lookat`, `transform`, or `K` with `R` and `t`",
                ));
            }
        };
        if !camera_from_world.inverse.is_finite() {
            return Err(refusal(
                "a matrix without a finite inverse",
                "a place in the world",
            ));
        }
        Ok(Pose {
            name,
            camera_from_world,
            lens,
        })
    }

    fn lens_of_scene(&self) -> std::result::Result<Lens, Refusal> {
        if self.resolution.is_some() {
            let expected =
                "it beside `K` alone; else the film is the scene's, or as --resolution says";
            return Err(("a `resolution`".to_owned(), expected.to_owned()));
        }
        match self.fov {
            Some(fov) if !(fov > 0.0 && fov < 180.0) => Err((
                format!("a field of view of {fov} degrees"),
                "more than 0 and less than 180".to_owned(),
            )),
            fov => Ok(Lens::OfScene { fov }),
        }
    }
}

fn look_at(numbers: &[f64; 9]) -> std::result::Result<Transform, Refusal> {
    let [ex, ey, ez, lx, ly, lz, ux, uy, uz] = *numbers;
    let transform = Transform::look_at(
        Point::new(ex, ey, ez),
        Point::new(lx, ly, lz),
        Vector::new(ux, uy, uz),
    );
    // The directive is multiplied to the identity, too: this decides the signs of zeros.
    transform
        .map(|transform| Transform::IDENTITY.times(&transform))
        .ok_or_else(|| {
            let expected = "an eye, another point to look at, \
                        and a direction upwards that is not along the view";
            (
                "a `lookat` without a direction".to_owned(),
                expected.to_owned(),
            )
        })
}

impl Pose {
    /// The name of the camera: unique in the list, and valid in a file name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The camera and its film in `scene`.
    pub fn place(&self, scene: &Scene) -> (Camera, Film) {
        let world_from_camera: Matrix = self.camera_from_world.inverse;
        match &self.lens {
            Lens::OfScene { fov } => {
                let projection = fov.map_or(scene.camera.projection, Projection::perspective);
                (
                    Camera {
                        world_from_camera,
                        projection,
                        ..scene.camera.clone()
                    },
                    scene.film.clone(),
                )
            }
            Lens::Calibrated(intrinsics) => (
                intrinsics.camera(world_from_camera),
                intrinsics.film(&scene.film),
            ),
        }
    }

    /// Whether the camera has a resolution of its own.
    pub fn has_resolution(&self) -> bool {
        matches!(self.lens, Lens::Calibrated(_))
    }
}
