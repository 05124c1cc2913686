//! Cameras that a file lists, to see one scene from many places.
//!
//! JSON, a list of objects. Each says where its camera stands, as pbrt does or as computer vision does:
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
//! `lookat` and `transform` are the numbers of the directives `LookAt` and `Transform` that would stand before a `Camera`. The film
//! and the lens are then those of the scene, but for `fov`.

use super::intrinsics::{self, Intrinsics, Refusal};
use super::scalar::Scalar;
use crate::camera::{Camera, Projection};
use crate::error::{Diagnostic, Error, Result, SourceLocation, printable};
use crate::geometry::{Matrix, Point, Transform, Vector};
use crate::input;
use crate::scene::{Film, Scene};
use crate::terminal_text::is_command;
use serde::Deserialize;
use std::collections::HashSet;
use std::path::Path;

/// Cameras of a file at most.
const MAX_POSES: usize = 1_000_000;

/// Bytes of a name at most: it becomes part of a file name.
const MAX_NAME: usize = 100;

/// One camera of the list.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    name: String,
    camera_from_world: Transform,
    lens: Lens,
}

/// What the camera's film shows.
#[derive(Debug, Clone, PartialEq)]
enum Lens {
    /// As the scene says, but for a field of view in degrees.
    OfScene { fov: Option<f64> },
    /// Of a camera that was calibrated.
    Calibrated(Intrinsics),
}

/// One of the list as it stands in the file.
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

/// Reads the list in the file `path`.
///
/// # Errors
/// A file that cannot be read, is not such a list, or has a camera that sees nothing or has another one's name.
pub fn read_poses(path: &Path) -> Result<Vec<Pose>> {
    parse_poses(path, &input::read(path)?)
}

/// The list in `bytes`, the content of the file `path`.
///
/// # Errors
/// As [`read_poses`].
pub fn parse_poses(path: &Path, bytes: &[u8]) -> Result<Vec<Pose>> {
    let entries: Vec<Entry> = entries(bytes).map_err(|error| wrong_json(path, bytes, error))?;
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

fn entries(
    bytes: &[u8],
) -> std::result::Result<Vec<Entry>, serde_path_to_error::Error<serde_json::Error>> {
    let mut json = serde_json::Deserializer::from_slice(bytes);
    let mut track = serde_path_to_error::Track::new();
    let entries = Vec::<Entry>::deserialize(serde_path_to_error::Deserializer::new(
        &mut json, &mut track,
    ));
    let entries = entries.and_then(|entries| json.end().map(|()| entries));
    entries.map_err(|error| serde_path_to_error::Error::new(track.path(), error))
}

/// The camera, from 1, and its field that `path` leads to, in words.
fn in_words(path: &serde_path_to_error::Path) -> Option<String> {
    use serde_path_to_error::Segment;
    let mut segments = path.iter();
    let Some(Segment::Seq { index }) = segments.next() else {
        return None;
    };
    let camera = format!("camera {}", index + 1);
    match segments.next() {
        Some(Segment::Map { key }) => Some(format!("{camera}, `{}`", printable(key))),
        _ => Some(camera),
    }
}

/// How the field that `path` leads to is written.
fn form_of(path: &serde_path_to_error::Path) -> &'static str {
    use serde_path_to_error::Segment;
    let key = path.iter().find_map(|segment| match segment {
        Segment::Map { key } => Some(key.as_str()),
        _ => None,
    });
    match key {
        Some("name") => "expected \"name\": \"a\"",
        Some("lookat") => {
            "expected \"lookat\": 9 numbers: [eye x, y, z, a point to look at, the direction upwards]"
        }
        Some("transform") => {
            "expected \"transform\": 16 numbers as `Transform` takes them, column by column"
        }
        Some("fov") => "expected \"fov\": degrees",
        Some("K") => "expected \"K\": [[fx, 0, cx], [0, fy, cy], [0, 0, 1]], in pixels",
        Some("R") => "expected \"R\": three rows of three numbers",
        Some("t") => "expected \"t\": [x, y, z]",
        Some("resolution") => "expected \"resolution\": [width, height]",
        _ => "expected a list of cameras: [{\"name\": \"a\", \"lookat\": [...]}, ...]",
    }
}

fn wrong_json(
    path: &Path,
    bytes: &[u8],
    error: serde_path_to_error::Error<serde_json::Error>,
) -> Error {
    let (field, form) = (in_words(error.path()), form_of(error.path()));
    let error = error.into_inner();
    let line_start = match error.line().saturating_sub(1) {
        0 => 0,
        lines => bytes
            .iter()
            .enumerate()
            .filter(|(_, byte)| **byte == b'\n')
            .nth(lines - 1)
            .map_or(0, |(at, _)| at + 1),
    };
    let at = (line_start + error.column().saturating_sub(1)).min(bytes.len());
    let place = format!(" at line {} column {}", error.line(), error.column());
    let message = error.to_string().replace(&place, "");
    let message = field.map_or(message.clone(), |field| format!("{field}: {message}"));
    let diagnostic = Diagnostic::new(message).at(SourceLocation::text(path, bytes, at..at + 1));
    Error::bad_input(diagnostic.note(form))
}

fn check_name(name: &str) -> std::result::Result<(), Refusal> {
    let is_bad = |c: char| is_command(c) || "/\\:*?\"<>|{}".contains(c);
    if name.is_empty() || name.len() > MAX_NAME || name.starts_with('.') || name.chars().any(is_bad)
    {
        let expected = format!("a part of a file name, of {MAX_NAME} bytes at most");
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
                let expected = "16 numbers as `Transform` takes them, of which the 4th, 8th and 12th are 0 and the last is not";
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
    // As a directive would have it, to the sign of zeros: it is multiplied to the transform that stands there.
    transform.map(|transform| Transform::IDENTITY.times(&transform)).ok_or_else(|| {
        let expected = "an eye, another point to look at, and a direction upwards that is not along the view";
        ("a `lookat` without a direction".to_owned(), expected.to_owned())
    })
}

impl Pose {
    /// What it is called; unique in the list, and fit for a part of a file name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The camera at this place, and its film, in `scene`.
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

    /// Whether it says itself how many pixels there are.
    pub fn has_resolution(&self) -> bool {
        matches!(self.lens, Lens::Calibrated(_))
    }
}
