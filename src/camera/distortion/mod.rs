//! Lenses that distort, as OpenCV describes them: from a place on the film to a direction (rule
//! R5).

mod fisheye;
mod polynomial;
mod radial_tangential;

pub use fisheye::Fisheye;
pub use radial_tangential::RadialTangential;

/// How a lens distorts: a point at `x/z` and `y/z` in camera space appears elsewhere in the plane
/// at distance 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distortion {
    /// OpenCV's usual model: `k1, k2, p1, p2` and more.
    RadialTangential(RadialTangential),
    /// OpenCV's fisheye model.
    Fisheye(Fisheye),
}

impl Distortion {
    /// Its name in OpenCV.
    pub fn name(&self) -> &'static str {
        match self {
            Distortion::RadialTangential(_) => "radial-tangential",
            Distortion::Fisheye(_) => "fisheye",
        }
    }

    /// Its coefficients: k1, k2, k3, that of the eighth power, k4, k5, k6, p1 and p2; or k1 to k4
    /// of a fisheye.
    pub fn coefficients(&self) -> Vec<f64> {
        match self {
            Distortion::RadialTangential(lens) => lens.coefficients().collect(),
            Distortion::Fisheye(lens) => lens.coefficients().to_vec(),
        }
    }

    /// The direction in camera space, y upwards, of what appears at X and Y in the plane at
    /// distance 1. `None` if the model shows nothing there: it is beyond the circle where the model
    /// folds back.
    pub fn direction(&self, [x, y]: [f64; 2]) -> Option<[f64; 3]> {
        // OpenCV's y points down.
        let seen = [x, 0.0 - y];
        let found = match self {
            Distortion::RadialTangential(lens) => lens.undistorted(seen).map(|[x, y]| [x, y, 1.0]),
            Distortion::Fisheye(lens) => lens.direction(seen),
        };
        found.map(|[x, y, z]| [x, 0.0 - y, z])
    }
}
