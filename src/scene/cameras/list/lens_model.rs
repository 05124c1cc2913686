//! Models of lenses by their names and coefficients in other programs.

use super::checks::Refusal;
use crate::camera::{Distortion, Fisheye, RadialTangential};

/// A lens; `None` if it does not distort.
type Lens = Result<Option<Distortion>, Refusal>;

/// OpenCV's `distCoeffs`: k1, k2, p1, p2, k3, k4, k5, k6, of which there may be 4, 5 or 8; thin
/// prisms and tilted sensors, which are the 9th to the 14th, only if they are 0.
pub(super) fn of_opencv(coefficients: &[f64]) -> Lens {
    let mut k = [0.0; 14];
    if ![0, 4, 5, 8, 12, 14].contains(&coefficients.len()) {
        return Err((
            format!("{} coefficients of a lens", coefficients.len()),
            "OpenCV's k1, k2, p1, p2, or these and k3, or these and k4, k5, k6".to_owned(),
        ));
    }
    k[..coefficients.len()].copy_from_slice(coefficients);
    let [k1, k2, p1, p2, k3, k4, k5, k6, others @ ..] = k;
    if others != [0.0; 6] {
        return Err((
            "a thin prism or a tilted sensor".to_owned(),
            "0 for OpenCV's s1 to s4, tau_x and tau_y: undistort the images first".to_owned(),
        ));
    }
    radial_tangential([k1, k2, k3, 0.0], [k4, k5, k6], [p1, p2])
}

/// A lens by its radial coefficients, those of its divisor, and the tangential ones.
pub(super) fn radial_tangential(radial: [f64; 4], divisor: [f64; 3], p: [f64; 2]) -> Lens {
    let all = radial.iter().chain(&divisor).chain(&p);
    if all.copied().all(|k| k == 0.0) {
        return Ok(None);
    }
    let lens = RadialTangential::new(radial, divisor, p);
    lens.map(|lens| Some(Distortion::RadialTangential(lens)))
        .ok_or_else(too_large)
}

/// OpenCV's fisheye by k1 to k4. It bends rays also if all of them are 0.
pub(super) fn fisheye(coefficients: [f64; 4]) -> Lens {
    let lens = Fisheye::new(coefficients);
    lens.map(|lens| Some(Distortion::Fisheye(lens)))
        .ok_or_else(too_large)
}

fn too_large() -> Refusal {
    (
        "a coefficient of the lens that is above a million".to_owned(),
        "numbers such as -0.3".to_owned(),
    )
}

/// A model that is not supported, by the name it has in the file.
pub(super) fn unknown(name: &str) -> Refusal {
    (
        format!("the camera model {name}"),
        "PINHOLE, SIMPLE_PINHOLE, OPENCV, FULL_OPENCV, SIMPLE_RADIAL, RADIAL, OPENCV_FISHEYE, \
         SIMPLE_RADIAL_FISHEYE or RADIAL_FISHEYE: undistort the images first, as \
         `colmap image_undistorter` does"
            .to_owned(),
    )
}
