//! Cameras of feimos' own lists: objects that place a camera as pbrt or as computer vision does.
//!
//! ```json
//! [
//!     {"name": "front", "lookat": [0, 0, -3,  0, 0, 0,  0, 1, 0], "fov": 60},
//!     {"name": "moved", "transform": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 3, 1]},
//!     {"name": "real", "K": [[500, 0, 319.5], [0, 500, 239.5], [0, 0, 1]],
//!      "R": [[1, 0, 0], [0, -1, 0], [0, 0, -1]], "t": [0, 0, 3], "resolution": [640, 480],
//!      "distortion": [-0.28, 0.07, 0.0002, 0]}
//! ]
//! ```
//!
//! `lookat` and `transform` are the numbers of the directives `LookAt` and `Transform` before a
//! `Camera`. Film and lens are then the scene's; `fov` overrides its field of view.

use super::checks::Refusal;
use super::grid::Grid;
use super::intrinsics::{self, FocalLength, Intrinsics};
use super::lens_model;
use super::names::check_name;
use super::pose::{Lens, Pose};
use crate::camera::{Camera, Distortion};
use crate::error::{self, Error};
use crate::geometry::{Matrix, Point, Transform, Vector};
use serde::Deserialize;

type Result<T> = std::result::Result<T, Refusal>;

/// One camera as it stands in the file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Entry {
    name: Option<String>,
    lookat: Option<[f64; 9]>,
    transform: Option<[f64; 16]>,
    fov: Option<f64>,
    #[serde(rename = "K")]
    k: Option<Grid<3, 3>>,
    #[serde(rename = "R")]
    r: Option<Grid<3, 3>>,
    t: Option<Grid<3, 1>>,
    resolution: Option<[u32; 2]>,
    /// OpenCV's k1, k2, p1, p2, and more.
    distortion: Option<Vec<f64>>,
    /// OpenCV's k1 to k4 of a fisheye.
    fisheye: Option<[f64; 4]>,
}

/// The camera number `number` of a list, counted from 1; the number is its name if it has none.
pub(super) fn pose(entry: Entry, number: usize) -> Result<Pose> {
    let name = entry.name.clone().unwrap_or_else(|| number.to_string());
    let refused = |(found, expected): Refusal| {
        (
            format!("camera {number} of the list, `{name}`: {found}"),
            expected,
        )
    };
    check_name(&name)
        .and_then(|()| entry.pose(name.clone()))
        .map_err(refused)
}

/// The camera of `K`, `R` and `t`, like that of a list with these numbers.
///
/// # Errors
/// See [`read_poses`](super::read_poses).
pub fn calibrated_camera(
    k: &[[f64; 3]; 3],
    r: &[[f64; 3]; 3],
    t: &[f64; 3],
    resolution: [u32; 2],
) -> error::Result<Camera> {
    let camera = || {
        let intrinsics = intrinsics_of(k, Some(resolution), || Ok(None))?;
        let world_from_camera = finite(intrinsics::world_from_camera(r, t)?)?;
        Ok(intrinsics.camera(world_from_camera, resolution))
    };
    camera().map_err(|(found, expected): Refusal| {
        Error::usage(found).note(format!("expected {expected}"))
    })
}

impl Entry {
    fn pose(self, name: String) -> Result<Pose> {
        let refusal = |found: &str, expected: &str| (found.to_owned(), expected.to_owned());
        let (world_from_camera, lens) = match (self.lookat, self.transform, self.k, self.r, self.t)
        {
            (Some(numbers), None, None, None, None) => (look_at(&numbers)?, self.lens_of_scene()?),
            (None, Some(numbers), None, None, None) => {
                let transform = Transform::from_column_major(&numbers);
                let expected = "16 numbers as `Transform` takes them: \
                                the 4th, 8th and 12th are 0, the last is not";
                let transform =
                    transform.ok_or_else(|| refusal("a transform that is not affine", expected))?;
                (transform.inverse, self.lens_of_scene()?)
            }
            (None, None, Some(Grid(k)), Some(Grid(r)), Some(Grid(t))) => {
                if self.fov.is_some() {
                    return Err(refusal(
                        "both `fov` and `K`",
                        "`K` alone: it decides the field of view",
                    ));
                }
                (
                    intrinsics::world_from_camera(&r, &t.map(|[x]| x))?,
                    Lens::Calibrated(intrinsics_of(&k, self.resolution, || self.lens())?),
                )
            }
            _ => {
                return Err(refusal(
                    "no single place for the camera",
                    "one of `lookat`, `transform`, or `K` with `R` and `t`",
                ));
            }
        };
        Ok(Pose {
            name,
            world_from_camera: finite(world_from_camera)?,
            lens,
        })
    }

    fn lens(&self) -> Result<Option<Distortion>> {
        match (&self.distortion, self.fisheye) {
            (None, None) => Ok(None),
            (Some(coefficients), None) => lens_model::of_opencv(coefficients),
            (None, Some(coefficients)) => lens_model::fisheye(coefficients),
            (Some(_), Some(_)) => Err((
                "both `distortion` and `fisheye`".to_owned(),
                "one model of the lens".to_owned(),
            )),
        }
    }

    fn lens_of_scene(&self) -> Result<Lens> {
        if self.resolution.is_some() {
            let expected =
                "it beside `K` alone; else the film is the scene's, or as --resolution says";
            return Err(("a `resolution`".to_owned(), expected.to_owned()));
        }
        if self.distortion.is_some() || self.fisheye.is_some() {
            let expected = "it beside `K` alone: its numbers count in focal lengths";
            return Err(("a lens that distorts".to_owned(), expected.to_owned()));
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

fn intrinsics_of(
    k: &[[f64; 3]; 3],
    resolution: Option<[u32; 2]>,
    distortion: impl FnOnce() -> Result<Option<Distortion>>,
) -> Result<Intrinsics> {
    let [[fx, skew, cx], [zero, fy, cy], last] = *k;
    if zero != 0.0 || last != [0.0, 0.0, 1.0] {
        return Err((
            intrinsics::NO_PINHOLE.0.to_owned(),
            intrinsics::NO_PINHOLE.1.to_owned(),
        ));
    }
    if skew != 0.0 {
        let expected = "0 in its place: pixels are rectangles here; rectify the images first";
        return Err((format!("a skew of {skew} in `K`"), expected.to_owned()));
    }
    let Some(resolution) = resolution else {
        let expected = "\"resolution\": [width, height] of the images that `K` is about";
        return Err(("`K` without a `resolution`".to_owned(), expected.to_owned()));
    };
    Intrinsics {
        focal_length: FocalLength::InPixels([fx, fy]),
        principal_point: Some([cx, cy]),
        first_centre: 0.0,
        resolution: Some(resolution),
        distortion: distortion()?,
    }
    .checked()
}

fn finite(world_from_camera: Matrix) -> Result<Matrix> {
    match world_from_camera.is_finite() {
        true => Ok(world_from_camera),
        false => Err((
            "a matrix without a finite inverse".to_owned(),
            "a place in the world".to_owned(),
        )),
    }
}

fn look_at(numbers: &[f64; 9]) -> Result<Matrix> {
    let [ex, ey, ez, lx, ly, lz, ux, uy, uz] = *numbers;
    let transform = Transform::look_at(
        Point::new(ex, ey, ez),
        Point::new(lx, ly, lz),
        Vector::new(ux, uy, uz),
    );
    // The directive is multiplied to the identity, too: this decides the signs of zeros.
    transform
        .map(|transform| Transform::IDENTITY.times(&transform).inverse)
        .ok_or_else(|| {
            let expected = "an eye, another point to look at, \
                        and a direction upwards that is not along the view";
            (
                "a `lookat` without a direction".to_owned(),
                expected.to_owned(),
            )
        })
}
