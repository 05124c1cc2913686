//! The columns of a matrix, and their determinant.

use crate::exact::{Dyadic, ExactVector};
use crate::geometry::Matrix;
use crate::per_axis::per_axis;

/// The columns of the linear part of a finite matrix.
pub(super) fn columns(m: &Matrix) -> [ExactVector; 3] {
    per_axis(|j| ExactVector::from(m.column(j)))
}

/// The determinant of the matrix with these columns.
pub(super) fn determinant([x, y, z]: &[ExactVector; 3]) -> Dyadic {
    x.dot(&y.cross(z))
}
