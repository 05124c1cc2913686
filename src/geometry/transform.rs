//! Transforms with their tracked inverses (rules R2 and R3).

use super::{Matrix, Point, Vector};
use crate::exact::degrees;

/// A matrix and its inverse, each built on its own from the leaves, as in pbrt.
///
/// The inverse is not computed from the matrix, but tracked along with it. So a camera placed by a
/// `LookAt` is exactly at the eye point in the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// The current transformation matrix.
    pub matrix: Matrix,
    /// Its inverse, up to the roundings of R2 and R3.
    pub inverse: Matrix,
}

impl Transform {
    /// The identity.
    pub const IDENTITY: Transform = Transform {
        matrix: Matrix::IDENTITY,
        inverse: Matrix::IDENTITY,
    };

    /// All entries are NaN.
    pub const NOT_A_TRANSFORM: Transform = Transform {
        matrix: Matrix::NOT_A_MATRIX,
        inverse: Matrix::NOT_A_MATRIX,
    };

    /// A translation by `offset`.
    pub fn translate(offset: [f64; 3]) -> Transform {
        Transform {
            matrix: Matrix::translate(offset),
            inverse: Matrix::translate(offset.map(|t| -t)),
        }
    }

    /// A scale of each axis; a factor of 0 makes the inverse infinite.
    pub fn scale(factors: [f64; 3]) -> Transform {
        Transform {
            matrix: Matrix::scale(factors),
            inverse: Matrix::scale(factors.map(|s| 1.0 / s)),
        }
    }

    /// A rotation by `angle` degrees about `axis`, with correctly rounded sine and cosine.
    pub fn rotate(angle: f64, axis: Vector) -> Transform {
        let a = axis.normalized();
        let (s, c) = (degrees::sine(angle), degrees::cosine(angle));
        let (a0, a1, a2) = (a.x, a.y, a.z);
        let rows = [
            [
                a0 * a0 + (1.0 - a0 * a0) * c,
                (a0 * a1) * (1.0 - c) - a2 * s,
                (a0 * a2) * (1.0 - c) + a1 * s,
                0.0,
            ],
            [
                (a0 * a1) * (1.0 - c) + a2 * s,
                a1 * a1 + (1.0 - a1 * a1) * c,
                (a1 * a2) * (1.0 - c) - a0 * s,
                0.0,
            ],
            [
                (a0 * a2) * (1.0 - c) - a1 * s,
                (a1 * a2) * (1.0 - c) + a0 * s,
                a2 * a2 + (1.0 - a2 * a2) * c,
                0.0,
            ],
        ];
        let matrix = Matrix { rows };
        Transform {
            matrix,
            inverse: matrix.transposed(),
        }
    }

    /// Camera space from world space: the eye at the origin, `look` on +z, `up` towards +y.
    ///
    /// `None` if `up` is parallel to the view, or eye and look coincide; pbrt then uses the
    /// identity.
    pub fn look_at(eye: Point, look: Point, up: Vector) -> Option<Transform> {
        let forward = (look - eye).normalized();
        let right = up.normalized().cross(forward);
        if right == Vector::default() {
            return None;
        }
        let right = right.normalized();
        let up = forward.cross(right);
        let inverse = Matrix::from_columns(right, up, forward, eye);
        let row = |a: Vector| [a.x, a.y, a.z, -((a.x * eye.x + a.y * eye.y) + a.z * eye.z)];
        Some(Transform {
            matrix: Matrix {
                rows: [row(right), row(up), row(forward)],
            },
            inverse,
        })
    }

    /// The 16 numbers of a `Transform` directive, column by column. The last row must be `0 0 0 w`
    /// with a finite w other than 0: all entries are divided by it, as pbrt divides points (rule
    /// R2). `None` for other matrices, which are projective or singular.
    pub fn from_column_major(m: &[f64; 16]) -> Option<Transform> {
        let ([a, b, c], w) = ([m[3], m[7], m[11]], m[15]);
        if [a, b, c] != [0.0; 3] || w == 0.0 || !w.is_finite() {
            return None;
        }
        let numbers = Matrix {
            rows: std::array::from_fn(|i| std::array::from_fn(|j| m[4 * j + i])),
        };
        let matrix = Matrix {
            rows: numbers.rows.map(|row| row.map(|entry| entry / w)),
        };
        Some(Transform {
            matrix,
            inverse: numbers.inverse_of_quotient(w),
        })
    }

    /// `self * right`: the current transform after the directive `right` (rule R3).
    pub fn times(&self, right: &Transform) -> Transform {
        Transform {
            matrix: self.matrix.times(&right.matrix),
            inverse: right.inverse.times(&self.inverse),
        }
    }

    /// The inverse transform.
    pub fn inverted(&self) -> Transform {
        Transform {
            matrix: self.inverse,
            inverse: self.matrix,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        let turn = Transform::rotate(90.0, Vector::new(0.0, 0.0, 2.0));
        assert_eq!(
            turn.matrix.apply(Point::new(1.0, 0.0, 0.0)),
            Point::new(0.0, 1.0, 0.0)
        );
        assert_eq!(
            turn.inverse.apply(Point::new(0.0, 1.0, 0.0)),
            Point::new(1.0, 0.0, 0.0)
        );
    }

    #[test]
    fn look_at_keeps_the_eye() {
        let eye = Point::new(0.1, 0.2, 0.3);
        let camera_from_world =
            Transform::look_at(eye, Point::new(4.0, 5.0, 6.0), Vector::new(0.0, 1.0, 0.0));
        assert_eq!(camera_from_world.unwrap().inverse.column(3), eye.to_array());
    }

    #[test]
    fn look_at_without_a_direction_is_none() {
        let eye = Point::new(0.0, 0.0, 0.0);
        let up = Vector::new(0.0, 1.0, 0.0);
        assert!(Transform::look_at(eye, Point::new(0.0, 2.0, 0.0), up).is_none());
    }

    #[test]
    fn sixteen_numbers_are_column_major() {
        let mut m = [0.0; 16];
        (m[0], m[5], m[10], m[15]) = (1.0, 1.0, 1.0, 1.0);
        (m[12], m[13], m[14]) = (7.0, 8.0, 9.0);
        assert_eq!(
            Transform::from_column_major(&m).unwrap(),
            Transform::translate([7.0, 8.0, 9.0])
        );
        m[3] = 0.5;
        assert!(Transform::from_column_major(&m).is_none());
    }

    #[test]
    fn sixteen_numbers_are_divided_by_the_last() {
        let mut m = [0.0; 16];
        (m[0], m[5], m[10], m[15]) = (3.0, -3.0, 1.0, 3.0);
        (m[12], m[13], m[14]) = (6.0, 1.0, -9.0);
        let transform = Transform::from_column_major(&m).unwrap();
        let rows = [
            [1.0, 0.0, 0.0, 2.0],
            [0.0, -1.0, 0.0, 1.0 / 3.0],
            [0.0, 0.0, 1.0 / 3.0, -3.0],
        ];
        assert_eq!(transform.matrix.rows, rows);
        // The inverse is that of the exact quotients, not of the rounded ones: 3 and 9 are whole.
        let inverse = [
            [1.0, 0.0, 0.0, -2.0],
            [0.0, -1.0, 0.0, 1.0 / 3.0],
            [0.0, 0.0, 3.0, 9.0],
        ];
        assert_eq!(transform.inverse.rows, inverse);
        for w in [0.0, -0.0, f64::NAN, f64::INFINITY] {
            m[15] = w;
            assert!(Transform::from_column_major(&m).is_none(), "{w}");
        }
        m[15] = -3.0;
        assert_eq!(
            Transform::from_column_major(&m).unwrap().matrix.rows[0],
            [-1.0, 0.0, 0.0, -2.0]
        );
    }
}
