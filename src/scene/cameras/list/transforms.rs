//! `transforms.json`, as NeRF, Blender, instant-ngp and nerfstudio write it.
//!
//! `transform_matrix` leads from camera to world, with OpenGL's axes: x to the right, y up, z
//! backwards. Columns and rows are counted from the edge of the film, so that the first pixel has
//! its centre at 1/2. Lengths are `fl_x`, `fl_y`, `cx` and `cy` in pixels, or `camera_angle_x` in
//! radians. What stands beside `frames` holds for all of them; each may have numbers of its own.
//! Other fields are no part of the camera.

use super::checks::Refusal;
use super::grid::Affine;
use super::intrinsics::{FocalLength, Intrinsics, is_rotation};
use super::lens_model;
use super::names::{check_name, names_of_images};
use super::pose::{Lens, Pose};
use crate::camera::Distortion;
use crate::geometry::Matrix;
use serde::Deserialize;

type Result<T> = std::result::Result<T, Refusal>;

/// An object of the file: the whole, with `frames`, or one of them. Both may tell what cameras see
/// through.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
struct Block {
    frames: Option<Vec<Block>>,
    file_path: Option<String>,
    transform_matrix: Option<Affine>,
    camera_angle_x: Option<f64>,
    camera_angle_y: Option<f64>,
    fl_x: Option<f64>,
    fl_y: Option<f64>,
    cx: Option<f64>,
    cy: Option<f64>,
    w: Option<f64>,
    h: Option<f64>,
    k1: Option<f64>,
    k2: Option<f64>,
    k3: Option<f64>,
    k4: Option<f64>,
    k5: Option<f64>,
    k6: Option<f64>,
    p1: Option<f64>,
    p2: Option<f64>,
    is_fisheye: Option<bool>,
    camera_model: Option<String>,
}

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(transparent)]
pub(super) struct Transforms(Block);

impl Transforms {
    /// The number of frames.
    pub(super) fn count(&self) -> usize {
        self.frames().len()
    }

    fn frames(&self) -> &[Block] {
        self.0.frames.as_deref().unwrap_or_default()
    }

    /// The cameras of all frames.
    pub(super) fn poses(&self) -> Result<Vec<Pose>> {
        let numbers: Vec<String> = (1..=self.count()).map(|n| n.to_string()).collect();
        let images = self.frames().iter().zip(&numbers);
        let images: Vec<&str> = images
            .map(|(frame, number)| frame.file_path.as_deref().unwrap_or(number))
            .collect();
        let names = names_of_images(&images);
        let mut last = LastOptics::default();
        let named = self.frames().iter().zip(names).enumerate();
        named
            .map(|(place, (frame, name))| {
                let refused = |(found, expected): Refusal| {
                    (format!("frame {}, `{name}`: {found}", place + 1), expected)
                };
                check_name(&name).map_err(refused)?;
                let optics = || last.intrinsics(frame.over(&self.0));
                frame.pose(name.clone(), optics).map_err(refused)
            })
            .collect()
    }
}

/// What the frame before saw through: most frames share it, and the reach of a lens takes a tenth of
/// a millisecond.
#[derive(Default)]
struct LastOptics(Option<(Block, Intrinsics)>);

impl LastOptics {
    fn intrinsics(&mut self, optics: Block) -> Result<Intrinsics> {
        if let Some((known, intrinsics)) = &self.0
            && *known == optics
        {
            return Ok(intrinsics.clone());
        }
        let intrinsics = optics.intrinsics()?;
        self.0 = Some((optics, intrinsics.clone()));
        Ok(intrinsics)
    }
}

impl Block {
    fn pose(&self, name: String, intrinsics: impl FnOnce() -> Result<Intrinsics>) -> Result<Pose> {
        let Some(Affine(matrix)) = self.transform_matrix else {
            return Err((
                "no `transform_matrix`".to_owned(),
                "the matrix from camera to world".to_owned(),
            ));
        };
        let intrinsics = intrinsics()?;
        Ok(Pose {
            name,
            world_from_camera: world_from_camera(&matrix)?,
            lens: Lens::Calibrated(intrinsics),
        })
    }
}

/// The matrix with pbrt's axes, whose z points forwards.
fn world_from_camera(matrix: &[[f64; 4]; 3]) -> Result<Matrix> {
    let is_finite = matrix.iter().all(|row| row[3].is_finite());
    if !is_finite || !is_rotation(&matrix.map(|[x, y, z, _]| [x, y, z])) {
        return Err((
            "a `transform_matrix` that is not a rotation and a translation".to_owned(),
            "columns of length 1, at right angles, and no mirror: a scale belongs to the scene"
                .to_owned(),
        ));
    }
    // Adding to 0 makes zeros positive, as those of a matrix that was inverted are.
    let rows = matrix.map(|[x, y, z, w]| [0.0 + x, 0.0 + y, 0.0 - z, 0.0 + w]);
    Ok(Matrix { rows })
}

impl Block {
    /// These numbers, and those of `shared` where there are none. A focal length of its own hides
    /// an angle that is shared, and the reverse.
    fn over(&self, shared: &Block) -> Block {
        let own_length = self.fl_x.is_some() || self.camera_angle_x.is_some();
        let length = if own_length { self } else { shared };
        Block {
            camera_angle_x: length.camera_angle_x,
            camera_angle_y: length.camera_angle_y,
            fl_x: length.fl_x,
            fl_y: length.fl_y,
            cx: self.cx.or(shared.cx),
            cy: self.cy.or(shared.cy),
            w: self.w.or(shared.w),
            h: self.h.or(shared.h),
            k1: self.k1.or(shared.k1),
            k2: self.k2.or(shared.k2),
            k3: self.k3.or(shared.k3),
            k4: self.k4.or(shared.k4),
            k5: self.k5.or(shared.k5),
            k6: self.k6.or(shared.k6),
            p1: self.p1.or(shared.p1),
            p2: self.p2.or(shared.p2),
            is_fisheye: self.is_fisheye.or(shared.is_fisheye),
            camera_model: self.camera_model.clone().or(shared.camera_model.clone()),
            ..Block::default()
        }
    }

    fn intrinsics(&self) -> Result<Intrinsics> {
        let distortion = self.distortion()?;
        let focal_length = match (self.fl_x, self.camera_angle_x) {
            (Some(x), _) => FocalLength::InPixels([x, self.fl_y.unwrap_or(x)]),
            (None, Some(_)) if matches!(distortion, Some(Distortion::Fisheye(_))) => {
                return Err((
                    "`camera_angle_x` of a fisheye".to_owned(),
                    "`fl_x` in pixels".to_owned(),
                ));
            }
            (None, Some(x)) => FocalLength::ByAngles(x, self.camera_angle_y),
            (None, None) => {
                return Err((
                    "no focal length".to_owned(),
                    "`fl_x` in pixels, or `camera_angle_x` in radians".to_owned(),
                ));
            }
        };
        Intrinsics {
            focal_length,
            principal_point: self.principal_point()?,
            first_centre: 0.5,
            resolution: self.resolution()?,
            distortion,
        }
        .checked()
    }

    fn principal_point(&self) -> Result<Option<[f64; 2]>> {
        match (self.cx, self.cy) {
            (None, None) => Ok(None),
            (Some(cx), Some(cy)) => Ok(Some([cx, cy])),
            _ => Err((
                "`cx` or `cy` alone".to_owned(),
                "both, or neither for the middle of the film".to_owned(),
            )),
        }
    }

    fn resolution(&self) -> Result<Option<[u32; 2]>> {
        let whole = |side: f64| (side.fract() == 0.0 && (0.0..1e9).contains(&side)).then_some(side);
        match (self.w, self.h) {
            (None, None) if self.fl_x.is_none() => Ok(None),
            (Some(w), Some(h)) => match (whole(w), whole(h)) {
                (Some(w), Some(h)) => Ok(Some([w as u32, h as u32])),
                _ => Err((
                    format!("images of {w} x {h} pixels"),
                    "whole numbers".to_owned(),
                )),
            },
            _ => Err((
                "a focal length in pixels without `w` and `h`".to_owned(),
                "the width and height of the images that it is about".to_owned(),
            )),
        }
    }

    fn distortion(&self) -> Result<Option<Distortion>> {
        let or_none = |k: Option<f64>| k.unwrap_or(0.0);
        let [k1, k2, k3, k4] = [self.k1, self.k2, self.k3, self.k4].map(or_none);
        let tangential = [self.p1, self.p2].map(or_none);
        if [self.k5, self.k6].map(or_none) != [0.0; 2] {
            return Err((
                "`k5` or `k6`, which these files do not define".to_owned(),
                "k1 to k4, p1 and p2".to_owned(),
            ));
        }
        let is_fisheye = match self.camera_model.as_deref() {
            Some("OPENCV_FISHEYE") => true,
            Some(
                "OPENCV" | "PINHOLE" | "SIMPLE_PINHOLE" | "PERSPECTIVE" | "SIMPLE_RADIAL"
                | "RADIAL",
            )
            | None => self.is_fisheye.unwrap_or(false),
            Some(other) => return Err(lens_model::unknown(other)),
        };
        match is_fisheye {
            true if tangential != [0.0; 2] => Err((
                "`p1` or `p2` of a fisheye".to_owned(),
                "k1 to k4 alone".to_owned(),
            )),
            true => lens_model::fisheye([k1, k2, k3, k4]),
            false => lens_model::radial_tangential([k1, k2, k3, k4], [0.0; 3], tangential),
        }
    }
}

#[cfg(test)]
mod tests;
