//! Bilinear patches.
//!
//! With u and v from 0 to 1, a patch is the set of the points
//! (1-u) ((1-v) p00 + v p01) + u ((1-v) p10 + v p11). Its *rulings* are the segments with one u,
//! from A(u) = p00 + u (p10 - p00) along R(u) = (p01 - p00) + u (p11 - p10 - p01 + p00). The line
//! of a ray along d, relative to its origin, meets that of a ruling where A(u) . (R(u) x d) = 0,
//! which is a quadratic equation (Reshetov, "Cool Patches", Ray Tracing Gems, 2019).

mod exact;
mod filter;
mod single;
mod surface;
#[cfg(test)]
mod tests;

pub(crate) use single::intersect_patch;
pub(crate) use surface::PatchPoint;

use crate::geometry::{Bounds, Matrix, Point, Vector};
use crate::per_axis::per_axis;

/// The corners of a bilinear patch, in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Patch {
    /// p00, p10, p01 and p11.
    pub(crate) corners: [Point; 4],
}

impl Patch {
    /// The patch whose corners are the columns of `matrix`.
    pub(super) fn of_columns(matrix: &Matrix) -> Patch {
        Patch {
            corners: [0, 1, 2, 3].map(|k| Point::from(matrix.column(k))),
        }
    }

    /// The matrix whose columns are the corners.
    pub(crate) fn to_columns(self) -> Matrix {
        let [x, y, z, w] = self.corners;
        let vector = |point: Point| Vector::from(point.to_array());
        Matrix::from_columns(vector(x), vector(y), vector(z), w)
    }

    /// The box around it: that of its corners.
    pub(super) fn bounds(&self) -> Bounds {
        Bounds::of(self.corners)
    }

    /// The largest absolute coordinates.
    pub(super) fn extent(&self) -> [f64; 3] {
        let largest = |k: usize| {
            self.corners
                .iter()
                .fold(0.0f64, |max, p| max.max(p[k].abs()))
        };
        per_axis(largest)
    }
}
