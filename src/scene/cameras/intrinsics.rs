//! Cameras of computer vision: `K`, `R` and `t`.
//!
//! A point X of the world is at x = R X + t in camera space, with x to the right, y down and z
//! forwards. It is seen at K x: at column fx x/z + cx and row fy y/z + cy, where integers are the
//! centres of pixels (Hartley and Zisserman, Multiple View Geometry, 6.1; OpenCV's conventions).

use crate::camera::{Camera, Projection, ScreenWindow};
use crate::film::PixelBounds;
use crate::geometry::{Matrix, Transform, Vector};
use crate::scene::Film;

/// What was found, and what was expected.
pub(super) type Refusal = (String, String);

/// A pinhole camera without skew; lengths in pixels.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Intrinsics {
    focal_length: [f64; 2],
    principal_point: [f64; 2],
    /// Width and height of the images that were calibrated.
    resolution: [u32; 2],
}

impl Intrinsics {
    pub(super) fn new(
        k: &[[f64; 3]; 3],
        resolution: Option<[u32; 2]>,
    ) -> Result<Intrinsics, Refusal> {
        let [[fx, skew, cx], [zero, fy, cy], last] = *k;
        let is_pinhole = fx > 0.0
            && fy > 0.0
            && fx.is_finite()
            && fy.is_finite()
            && cx.is_finite()
            && cy.is_finite();
        if !is_pinhole || zero != 0.0 || last != [0.0, 0.0, 1.0] {
            let expected =
                "[[fx, 0, cx], [0, fy, cy], [0, 0, 1]] with fx and fy above 0, in pixels";
            return Err((
                "a matrix `K` that is not that of a pinhole camera".to_owned(),
                expected.to_owned(),
            ));
        }
        if skew != 0.0 {
            let expected = "0 in its place: pixels are rectangles here; rectify the images first";
            return Err((format!("a skew of {skew} in `K`"), expected.to_owned()));
        }
        let most = PixelBounds::MAX_SIDE;
        let Some(resolution) = resolution else {
            let expected = "\"resolution\": [width, height] of the images that `K` is about";
            return Err(("`K` without a `resolution`".to_owned(), expected.to_owned()));
        };
        if resolution.iter().any(|side| !(1..=most).contains(side)) {
            return Err((
                "a `resolution` without pixels, or too large".to_owned(),
                format!("two numbers from 1 to {most}"),
            ));
        }
        Ok(Intrinsics {
            focal_length: [fx, fy],
            principal_point: [cx, cy],
            resolution,
        })
    }

    /// The film of the image; with the scene's crop if it has the resolution of the scene.
    pub(super) fn film(&self, of_scene: &Film) -> Film {
        let resolution = self.resolution;
        if resolution == of_scene.resolution {
            return of_scene.clone();
        }
        Film {
            resolution,
            crop: PixelBounds::of_film(resolution[0], resolution[1]),
            ..of_scene.clone()
        }
    }

    /// The camera whose pixels look in the directions of those of `K`.
    pub(super) fn camera(&self, world_from_camera: Matrix) -> Camera {
        let resolution = self.resolution;
        let ([fx, fy], [cx, cy]) = (self.focal_length, self.principal_point);
        let [width, height] = resolution.map(f64::from);
        // The film begins half a pixel before the first centre. Rows go down, and y goes up.
        let column = |edge: f64| (edge - 0.5 - cx) / fx;
        let row = |edge: f64| -((edge - 0.5 - cy) / fy);
        let screen_window = ScreenWindow {
            x0: column(0.0),
            x1: column(width),
            y0: row(height),
            y1: row(0.0),
        };
        Camera {
            world_from_camera,
            projection: Projection::Perspective { tangent: 1.0 },
            screen_window,
            resolution,
        }
    }
}

/// How far R may deviate from a rotation: datasets write few digits.
const TOLERANCE: f64 = 1e-3;

/// Camera space with y up, as in scenes, from world space.
pub(super) fn camera_from_world(r: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<Transform, Refusal> {
    let rows = r.map(Vector::from);
    let is_off = |i: usize, j: usize| {
        let expected = if i == j { 1.0 } else { 0.0 };
        let off = (rows[i].dot(rows[j]) - expected).abs();
        off.is_nan() || off > TOLERANCE
    };
    let is_rotation =
        !(0..3).any(|i| (0..3).any(|j| is_off(i, j))) && rows[0].cross(rows[1]).dot(rows[2]) > 0.0;
    if !is_rotation || !t.iter().all(|x| x.is_finite()) {
        let expected = "`R` to turn the world to the camera \
                        (rows of length 1, at right angles, determinant 1) and `t` to be finite";
        return Err((
            "`R` and `t` are not a rotation and a translation".to_owned(),
            expected.to_owned(),
        ));
    }
    let row = |i: usize, sign: f64| [sign * r[i][0], sign * r[i][1], sign * r[i][2], sign * t[i]];
    let matrix = Matrix {
        rows: [row(0, 1.0), row(1, -1.0), row(2, 1.0)],
    };
    Ok(Transform {
        matrix,
        inverse: matrix.inverse(),
    })
}
