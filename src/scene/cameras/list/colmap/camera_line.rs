//! A line of `cameras.txt`: number, model, width, height and parameters.

use super::super::checks::Refusal;
use super::super::intrinsics::{FocalLength, Intrinsics};
use super::super::lens_model;
use super::lines::{Line, number};
use crate::camera::Distortion;

/// A camera.
#[derive(Debug)]
pub(super) struct CameraLine {
    pub(super) number: u64,
    pub(super) intrinsics: Intrinsics,
}

impl CameraLine {
    pub(super) fn read(line: &Line) -> Result<CameraLine, Refusal> {
        let text = |word: &[u8]| String::from_utf8_lossy(word).into_owned();
        let mut words = line.words();
        let [id, model, width, height] = [0; 4].map(|_| words.next().map(text));
        let whole = |word: Option<String>| word.and_then(|word| word.parse::<u64>().ok());
        let (Some(id), Some(model), Some(width), Some(height)) =
            (whole(id), model, whole(width), whole(height))
        else {
            return Err(no_camera("a line that is no camera"));
        };
        let numbers: Option<Vec<f64>> = words.map(number).collect();
        let numbers = numbers.ok_or_else(|| no_camera("a parameter that is no number"))?;
        let (focal_length, principal_point, distortion) = lens(&model, &numbers)?;
        let side = |side: u64| u32::try_from(side).unwrap_or(u32::MAX);
        let intrinsics = Intrinsics {
            focal_length: FocalLength::InPixels(focal_length),
            principal_point: Some(principal_point),
            first_centre: 0.5,
            resolution: Some([side(width), side(height)]),
            distortion,
        };
        Ok(CameraLine {
            number: id,
            intrinsics: intrinsics.checked()?,
        })
    }
}

fn no_camera(found: &str) -> Refusal {
    (
        found.to_owned(),
        "a number, a model, width and height in pixels, and parameters: \
         1 PINHOLE 640 480 500 500 320 240"
            .to_owned(),
    )
}

/// The models, and their parameters in COLMAP's documentation.
const MODELS: [(&str, &str); 9] = [
    ("SIMPLE_PINHOLE", "f, cx, cy"),
    ("PINHOLE", "fx, fy, cx, cy"),
    ("SIMPLE_RADIAL", "f, cx, cy, k"),
    ("RADIAL", "f, cx, cy, k1, k2"),
    ("OPENCV", "fx, fy, cx, cy, k1, k2, p1, p2"),
    (
        "FULL_OPENCV",
        "fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6",
    ),
    ("OPENCV_FISHEYE", "fx, fy, cx, cy, k1, k2, k3, k4"),
    ("SIMPLE_RADIAL_FISHEYE", "f, cx, cy, k"),
    ("RADIAL_FISHEYE", "f, cx, cy, k1, k2"),
];

/// Focal lengths, principal point and distortion of a model.
type Optics = ([f64; 2], [f64; 2], Option<Distortion>);

fn lens(model: &str, numbers: &[f64]) -> Result<Optics, Refusal> {
    let Some((_, parameters)) = MODELS.iter().find(|(name, _)| *name == model) else {
        return Err(lens_model::unknown(model));
    };
    if parameters.split(", ").count() != numbers.len() {
        let found = format!("{} parameters of the model {model}", numbers.len());
        return Err((found, (*parameters).to_owned()));
    }
    // The parameter by the first of these names that the model has; 0 without any.
    let value = |names: &[&str]| {
        let mut named = parameters.split(", ").zip(numbers);
        let found = named.find(|(name, _)| names.contains(name));
        found.map_or(0.0, |(_, number)| *number)
    };
    let k = [["k", "k1"], ["", "k2"], ["", "k3"], ["", "k4"]].map(|names| value(&names));
    let distortion = if model.ends_with("FISHEYE") {
        lens_model::fisheye(k)?
    } else {
        let divisor = [k[3], value(&["k5"]), value(&["k6"])];
        let tangential = [value(&["p1"]), value(&["p2"])];
        lens_model::radial_tangential([k[0], k[1], k[2], 0.0], divisor, tangential)?
    };
    let focal_length = [value(&["f", "fx"]), value(&["f", "fy"])];
    Ok((focal_length, [value(&["cx"]), value(&["cy"])], distortion))
}
