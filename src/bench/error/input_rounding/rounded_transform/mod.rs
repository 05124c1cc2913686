//! Transforms with bounds of their rounding errors (rules R2 and R3).

#[cfg(test)]
mod tests;

use crate::exact::{Rounded, degrees};
use crate::geometry::{Matrix, Transform, Vector};
use crate::per_axis::per_axis;

/// Bounds of the absolute errors of a transform's entries: the differences from the transform that
/// exact arithmetic makes of the same numbers. Infinite if unknown, never NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TransformError {
    /// Errors of the matrix.
    pub(super) matrix: [[f64; 4]; 3],
    /// Errors of the tracked inverse.
    pub(super) inverse: [[f64; 4]; 3],
}

/// A transform with bounds of its errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RoundedTransform {
    /// The rounded transform.
    pub(super) transform: Transform,
    /// The bounds.
    pub(super) error: TransformError,
}

/// Entries, each with a bound.
type Entries = [[Rounded; 4]; 3];

impl RoundedTransform {
    /// The exact identity.
    pub(super) const IDENTITY: RoundedTransform = RoundedTransform {
        transform: Transform::IDENTITY,
        error: TransformError {
            matrix: [[0.0; 4]; 3],
            inverse: [[0.0; 4]; 3],
        },
    };

    /// [`Transform::translate`]: exact, and so is its inverse.
    pub(super) fn translate(offset: [f64; 3]) -> RoundedTransform {
        let Transform { matrix, inverse } = Transform::translate(offset);
        RoundedTransform::of(exact(&matrix), exact(&inverse))
    }

    /// [`Transform::scale`]: exact; the inverse is as exact as its quotients.
    pub(super) fn scale(factors: [f64; 3]) -> RoundedTransform {
        let mut inverse = exact(&Matrix::IDENTITY);
        for (axis, factor) in factors.into_iter().enumerate() {
            inverse[axis][axis] = Rounded::exactly(1.0).over(Rounded::exactly(factor));
        }
        RoundedTransform::of(exact(&Matrix::scale(factors)), inverse)
    }

    /// The transform of 16 numbers, by [`Transform::from_column_major`]: every entry of the inverse
    /// is correctly rounded; those of the matrix are exact unless they were `divided`, and then
    /// correctly rounded, too.
    pub(super) fn of_numbers(transform: &Transform, divided: bool) -> RoundedTransform {
        if transform.matrix == Matrix::IDENTITY && !divided {
            return RoundedTransform::IDENTITY;
        }
        let nearest = |matrix: &Matrix| matrix.rows.map(|row| row.map(Rounded::nearest));
        let matrix = if divided {
            nearest(&transform.matrix)
        } else {
            exact(&transform.matrix)
        };
        RoundedTransform::of(matrix, nearest(&transform.inverse))
    }

    /// [`Transform::rotate`], operation by operation. Sine and cosine are correctly rounded. They
    /// are exact if they are 0, 1/2 or 1 at a multiple of 30 degrees, and otherwise irrational
    /// (Niven's theorem).
    pub(super) fn rotate(angle: f64, axis: Vector) -> RoundedTransform {
        let [a0, a1, a2] = normalized(axis.to_array().map(Rounded::exactly));
        let correctly_rounded = |value: f64| {
            let is_exact = angle % 30.0 == 0.0 && (2.0 * value).fract() == 0.0;
            if is_exact {
                Rounded::exactly(value)
            } else {
                Rounded::nearest(value)
            }
        };
        let (s, c) = (
            correctly_rounded(degrees::sine(angle)),
            correctly_rounded(degrees::cosine(angle)),
        );
        let (one, zero) = (Rounded::exactly(1.0), Rounded::exactly(0.0));
        let on_diagonal = |a: Rounded| a * a + (one - a * a) * c;
        let beside = |a: Rounded, b: Rounded| (a * b) * (one - c);
        let rows = [
            [
                on_diagonal(a0),
                beside(a0, a1) - a2 * s,
                beside(a0, a2) + a1 * s,
                zero,
            ],
            [
                beside(a0, a1) + a2 * s,
                on_diagonal(a1),
                beside(a1, a2) - a0 * s,
                zero,
            ],
            [
                beside(a0, a2) - a1 * s,
                beside(a1, a2) + a0 * s,
                on_diagonal(a2),
                zero,
            ],
        ];
        let transposed = per_axis(|i| [rows[0][i], rows[1][i], rows[2][i], zero]);
        RoundedTransform::of(rows, transposed)
    }

    /// [`Transform::look_at`] of eye, look and up, if that is a transform, operation by operation.
    /// The closer up is to the view direction, the shorter is the vector that becomes right, and
    /// the larger its relative error. If the error reaches its length, the bounds are infinite.
    pub(super) fn look_at([eye, look, up]: [[f64; 3]; 3]) -> RoundedTransform {
        let [eye, look, up] = [eye, look, up].map(|vector| vector.map(Rounded::exactly));
        let forward = normalized(per_axis(|k| look[k] - eye[k]));
        let right = normalized(cross(normalized(up), forward));
        let up = cross(forward, right);
        let axes = [right, up, forward];
        let matrix = axes.map(|a| [a[0], a[1], a[2], -dot(a, eye)]);
        let inverse = per_axis(|k| [right[k], up[k], forward[k], eye[k]]);
        RoundedTransform::of(matrix, inverse)
    }

    /// [`Transform::times`]: the errors of both operands, and the roundings of the sums.
    pub(super) fn times(&self, right: &RoundedTransform) -> RoundedTransform {
        let matrix = product(&self.matrix(), &right.matrix());
        let inverse = product(&right.inverse(), &self.inverse());
        let error = TransformError {
            matrix: errors(&matrix),
            inverse: errors(&inverse),
        };
        RoundedTransform {
            transform: self.transform.times(&right.transform),
            error,
        }
    }

    /// [`Transform::inverted`].
    pub(super) fn inverted(&self) -> RoundedTransform {
        let TransformError { matrix, inverse } = self.error;
        let error = TransformError {
            matrix: inverse,
            inverse: matrix,
        };
        RoundedTransform {
            transform: self.transform.inverted(),
            error,
        }
    }

    /// The entries of the matrix with their bounds.
    pub(super) fn matrix(&self) -> [[Rounded; 4]; 3] {
        entries(&self.transform.matrix, &self.error.matrix)
    }

    /// The entries of the tracked inverse with their bounds.
    pub(super) fn inverse(&self) -> [[Rounded; 4]; 3] {
        entries(&self.transform.inverse, &self.error.inverse)
    }

    fn of(matrix: Entries, inverse: Entries) -> RoundedTransform {
        let values = |entries: &Entries| Matrix {
            rows: entries.map(|row| row.map(|entry| entry.value)),
        };
        let transform = Transform {
            matrix: values(&matrix),
            inverse: values(&inverse),
        };
        RoundedTransform {
            transform,
            error: TransformError {
                matrix: errors(&matrix),
                inverse: errors(&inverse),
            },
        }
    }
}

fn exact(matrix: &Matrix) -> Entries {
    matrix.rows.map(|row| row.map(Rounded::exactly))
}

fn entries(matrix: &Matrix, errors: &[[f64; 4]; 3]) -> Entries {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| Rounded::within(matrix.rows[i][j], errors[i][j]))
    })
}

fn errors(entries: &Entries) -> [[f64; 4]; 3] {
    entries.map(|row| row.map(|entry| entry.error))
}

/// [`Matrix::times`] with bounds. Its products with the fourth row are exact: 0 adds nothing, 1
/// changes nothing.
fn product(a: &Entries, b: &Entries) -> Entries {
    let entry = |a: &[Rounded; 4], j: usize| {
        let sum = a[0] * b[0][j] + a[1] * b[1][j] + a[2] * b[2][j];
        if j == 3 { sum + a[3] } else { sum }
    };
    a.map(|row| std::array::from_fn(|j| entry(&row, j)))
}

/// [`Vector::dot`] with bounds.
fn dot(a: [Rounded; 3], b: [Rounded; 3]) -> Rounded {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// [`Vector::cross`] with bounds.
fn cross(a: [Rounded; 3], b: [Rounded; 3]) -> [Rounded; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// [`Vector::normalized`] with bounds.
fn normalized(v: [Rounded; 3]) -> [Rounded; 3] {
    let length = dot(v, v).square_root();
    v.map(|component| component.over(length))
}
