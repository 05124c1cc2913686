//! Cameras of computer vision: `K`, `R` and `t`.
//!
//! A point X of the world is at x = R X + t in camera space, with x to the right, y down and z
//! forwards. It is seen at K x: at column fx x/z + cx and row fy y/z + cy, where integers are the
//! centres of pixels (Hartley and Zisserman, Multiple View Geometry, 6.1; OpenCV's conventions).

use super::checks::Refusal;
use crate::camera::{Camera, Distortion, Projection, ScreenWindow};
use crate::exact::degrees::sine_and_cosine_of_radians;
use crate::film::PixelBounds;
use crate::geometry::{Matrix, Vector};
use crate::scene::Film;
use std::f64::consts::PI;

/// A camera of one pixel size; lengths in pixels.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Intrinsics {
    pub(super) focal_length: FocalLength,
    /// Where the axis of the lens meets the film; the middle if there is no other.
    pub(super) principal_point: Option<[f64; 2]>,
    /// The column of the centre of the first pixel, and its row: 0 for OpenCV, 1/2 where 0 is the
    /// film's edge.
    pub(super) first_centre: f64,
    /// Width and height of the images that were calibrated; those of the scene if unknown.
    pub(super) resolution: Option<[u32; 2]>,
    pub(super) distortion: Option<Distortion>,
}

/// The focal length along columns and rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FocalLength {
    InPixels([f64; 2]),
    /// By the angles across the film in radians: of the width, and of the height unless pixels are
    /// squares.
    ByAngles(f64, Option<f64>),
}

/// What is said of a wrong focal length or principal point.
pub(super) const NO_PINHOLE: (&str, &str) = (
    "a matrix `K` that is not that of a pinhole camera",
    "[[fx, 0, cx], [0, fy, cy], [0, 0, 1]] with fx and fy above 0, in pixels",
);

impl FocalLength {
    /// In pixels, for a film of this size.
    fn in_pixels(self, [width, height]: [f64; 2]) -> [f64; 2] {
        let of = |side: f64, angle: f64| {
            let [sine, cosine] = sine_and_cosine_of_radians(angle / 2.0);
            (side * cosine) / (2.0 * sine)
        };
        match self {
            FocalLength::InPixels(lengths) => lengths,
            FocalLength::ByAngles(across, down) => {
                let fx = of(width, across);
                [fx, down.map_or(fx, |down| of(height, down))]
            }
        }
    }
}

impl Intrinsics {
    /// # Errors
    /// A number has no meaning.
    pub(super) fn checked(self) -> Result<Intrinsics, Refusal> {
        match self.focal_length {
            FocalLength::InPixels(lengths) => {
                let numbers = lengths.iter().chain(self.principal_point.iter().flatten());
                let are_finite = numbers.copied().all(f64::is_finite);
                if !are_finite || !lengths.iter().all(|length| *length > 0.0) {
                    return Err((NO_PINHOLE.0.to_owned(), NO_PINHOLE.1.to_owned()));
                }
            }
            FocalLength::ByAngles(across, down) => {
                let mut angles = [Some(across), down].into_iter().flatten();
                if let Some(angle) = angles.find(|angle| !(*angle > 0.0 && *angle < PI)) {
                    let expected = "radians between 0 and pi".to_owned();
                    return Err((format!("an angle of {angle} across the film"), expected));
                }
            }
        }
        let most = PixelBounds::MAX_SIDE;
        if self
            .resolution
            .iter()
            .flatten()
            .any(|side| !(1..=most).contains(side))
        {
            return Err((
                "a `resolution` without pixels, or too large".to_owned(),
                format!("two numbers from 1 to {most}"),
            ));
        }
        Ok(self)
    }

    /// Whether the size of the images is known.
    pub(super) fn has_resolution(&self) -> bool {
        self.resolution.is_some()
    }

    /// The film of the image; with the scene's crop if it has the resolution of the scene.
    pub(super) fn film(&self, of_scene: &Film) -> Film {
        match self.resolution {
            Some(resolution) if resolution != of_scene.resolution => Film {
                resolution,
                crop: PixelBounds::of_film(resolution[0], resolution[1]),
                ..of_scene.clone()
            },
            _ => of_scene.clone(),
        }
    }

    /// The camera whose pixels look in the directions of the calibrated ones, with a film of this
    /// many pixels.
    pub(super) fn camera(&self, world_from_camera: Matrix, resolution: [u32; 2]) -> Camera {
        let size = resolution.map(f64::from);
        let [fx, fy] = self.focal_length.in_pixels(size);
        // The film begins half a pixel before the first centre. Rows go down, and y goes up.
        let before = self.first_centre - 0.5;
        let [cx, cy] = self
            .principal_point
            .unwrap_or(size.map(|side| side / 2.0 + before));
        let column = |edge: f64| (edge + before - cx) / fx;
        let row = |edge: f64| -((edge + before - cy) / fy);
        let screen_window = ScreenWindow {
            x0: column(0.0),
            x1: column(size[0]),
            y0: row(size[1]),
            y1: row(0.0),
        };
        let pinhole = Projection::Perspective { tangent: 1.0 };
        Camera {
            world_from_camera,
            projection: self.distortion.map_or(pinhole, Projection::Distorted),
            screen_window,
            resolution,
        }
    }
}

/// How far R may deviate from a rotation: datasets write few digits.
const TOLERANCE: f64 = 1e-3;

/// World space from camera space with y up, as in scenes, of a camera to whose space, with y down,
/// `r` and `t` bring the world.
pub(super) fn world_from_camera(r: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<Matrix, Refusal> {
    if !is_rotation(r) || !t.iter().all(|x| x.is_finite()) {
        let expected = "`R` to turn the world to the camera \
                        (rows of length 1, at right angles, determinant 1) and `t` to be finite";
        return Err((
            "`R` and `t` are not a rotation and a translation".to_owned(),
            expected.to_owned(),
        ));
    }
    let row = |i: usize, sign: f64| [sign * r[i][0], sign * r[i][1], sign * r[i][2], sign * t[i]];
    let camera_from_world = Matrix {
        rows: [row(0, 1.0), row(1, -1.0), row(2, 1.0)],
    };
    Ok(camera_from_world.inverse())
}

/// Whether the rows have the length 1, are at right angles, and do not mirror, up to few digits.
pub(super) fn is_rotation(r: &[[f64; 3]; 3]) -> bool {
    let rows = r.map(Vector::from);
    let is_off = |i: usize, j: usize| {
        let expected = if i == j { 1.0 } else { 0.0 };
        let off = (rows[i].dot(rows[j]) - expected).abs();
        off.is_nan() || off > TOLERANCE
    };
    !(0..3).any(|i| (0..3).any(|j| is_off(i, j))) && rows[0].cross(rows[1]).dot(rows[2]) > 0.0
}
