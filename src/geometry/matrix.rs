//! Affine matrices, rounded as rules R2 to R4 say.

use super::{Point, Vector};
use crate::exact::{Dyadic, ExactVector, UNIT_ROUNDOFF, may_underflow_below};
use crate::per_axis::per_axis;
use std::cmp::Ordering;

/// The upper three rows of a 4x4 matrix whose last row is `0 0 0 1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matrix {
    /// `rows[i][j]` is the entry in row i and column j.
    pub rows: [[f64; 4]; 3],
}

impl Matrix {
    /// The identity.
    pub const IDENTITY: Matrix = Matrix {
        rows: [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ],
    };

    /// All NaN: the inverse of a singular matrix (rule R2).
    pub(super) const NOT_A_MATRIX: Matrix = Matrix {
        rows: [[f64::NAN; 4]; 3],
    };

    /// From three column vectors and the image of the origin.
    pub fn from_columns(x: Vector, y: Vector, z: Vector, origin: Point) -> Matrix {
        let row = |i| [x[i], y[i], z[i], origin[i]];
        Matrix {
            rows: [row(0), row(1), row(2)],
        }
    }

    /// A diagonal matrix.
    pub fn scale(factors: [f64; 3]) -> Matrix {
        let mut scale = Matrix::IDENTITY;
        for axis in 0..3 {
            scale.rows[axis][axis] = factors[axis];
        }
        scale
    }

    /// A translation by `offset`.
    pub fn translate(offset: [f64; 3]) -> Matrix {
        let mut translate = Matrix::IDENTITY;
        for axis in 0..3 {
            translate.rows[axis][3] = offset[axis];
        }
        translate
    }

    /// `self * right`, each entry `((a0*b0 + a1*b1) + a2*b2) + a3*b3` (rule R3).
    pub fn times(&self, right: &Matrix) -> Matrix {
        let entry = |a: &[f64; 4], j: usize| {
            let b = &right.rows;
            let b3 = if j == 3 { 1.0 } else { 0.0 };
            ((a[0] * b[0][j] + a[1] * b[1][j]) + a[2] * b[2][j]) + a[3] * b3
        };
        Matrix {
            rows: self.rows.map(|a| std::array::from_fn(|j| entry(&a, j))),
        }
    }

    /// The image of `point`: `((m0*x + m1*y) + m2*z) + m3` (rule R4).
    pub fn apply(&self, point: Point) -> Point {
        let image = |m: &[f64; 4]| ((m[0] * point.x + m[1] * point.y) + m[2] * point.z) + m[3];
        Point::new(
            image(&self.rows[0]),
            image(&self.rows[1]),
            image(&self.rows[2]),
        )
    }

    /// Column `j`: the image of an axis for 0 to 2, of the origin for 3.
    pub fn column(&self, j: usize) -> [f64; 3] {
        let [x, y, z] = &self.rows;
        [x[j], y[j], z[j]]
    }

    /// The transposed 3x3 part, without translation.
    pub fn transposed(&self) -> Matrix {
        let row = |i: usize| [self.rows[0][i], self.rows[1][i], self.rows[2][i], 0.0];
        Matrix {
            rows: [row(0), row(1), row(2)],
        }
    }

    /// Whether no entry is infinite or NaN.
    pub fn is_finite(&self) -> bool {
        self.rows.iter().flatten().all(|entry| entry.is_finite())
    }

    /// The bits of all entries: equal only for matrices that round alike.
    pub fn bits(&self) -> [u64; 12] {
        std::array::from_fn(|k| self.rows[k / 4][k % 4].to_bits())
    }

    /// The exact inverse, each entry correctly rounded; all NaN if there is none (rule R2).
    pub fn inverse(&self) -> Matrix {
        self.inverse_of_quotient(1.0)
    }

    /// The exact inverse of this matrix with every entry divided by `w`, each entry correctly
    /// rounded; all NaN if there is none (rule R2). `w` is finite and not 0.
    pub fn inverse_of_quotient(&self, w: f64) -> Matrix {
        if !self.is_finite() {
            return Matrix::NOT_A_MATRIX;
        }
        let (adjugate, determinant) = self.exact_adjugate();
        if determinant.is_zero() {
            return Matrix::NOT_A_MATRIX;
        }
        let offset = ExactVector::from(self.column(3));
        let w = Dyadic::from(w);
        // The offset is divided by w, too: w cancels in the last column.
        let row = |i: usize| {
            let moved = -&adjugate[i].dot(&offset);
            let entry = |j: usize| {
                if j < 3 {
                    &adjugate[i][j] * &w
                } else {
                    moved.clone()
                }
            };
            std::array::from_fn(|j| entry(j).quotient_to_f64(&determinant))
        };
        Matrix {
            rows: [row(0), row(1), row(2)],
        }
    }

    /// Whether the determinant of the 3x3 part is exactly 0. The matrix must be finite.
    pub fn is_singular(&self) -> bool {
        self.sign_of_determinant() == Ordering::Equal
    }

    /// Whether it mirrors, that is, the determinant of the 3x3 part is negative; decided exactly. A
    /// matrix that is not finite does not.
    pub fn swaps_handedness(&self) -> bool {
        self.is_finite() && self.sign_of_determinant() == Ordering::Less
    }

    fn sign_of_determinant(&self) -> Ordering {
        let column = |j| Vector::from(self.column(j));
        let (x, y, z) = (column(0), column(1), column(2));
        let magnitude = x.absolute().dot(y.absolute_cross(z));
        let determinant = x.dot(y.cross(z));
        // Two roundings of products, one of a difference, two of sums: less than the 8 units of
        // 2^-53.
        let sure = magnitude > may_underflow_below(x.largest())
            && determinant.abs() > 8.0 * UNIT_ROUNDOFF * magnitude;
        if sure {
            determinant.total_cmp(&0.0)
        } else {
            self.exact_adjugate().1.sign()
        }
    }

    /// The exact rows of the adjugate of the 3x3 part, which must be finite, and its determinant.
    pub fn exact_adjugate(&self) -> ([ExactVector; 3], Dyadic) {
        let [x, y, z] = per_axis(|j| ExactVector::from(self.column(j)));
        let rows = [y.cross(&z), z.cross(&x), x.cross(&y)];
        let determinant = x.dot(&rows[0]);
        (rows, determinant)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverts_with_one_rounding_an_entry() {
        let third = Matrix::scale([3.0, 3.0, -7.0]).inverse();
        assert_eq!(third, Matrix::scale([1.0 / 3.0, 1.0 / 3.0, -1.0 / 7.0]));
        let moved = Matrix {
            rows: [
                [0.0, 2.0, 0.0, 1.0],
                [0.5, 0.0, 0.0, -3.0],
                [0.0, 0.0, 4.0, 0.1],
            ],
        };
        let expected = Matrix {
            rows: [
                [0.0, 2.0, 0.0, 6.0],
                [0.5, 0.0, 0.0, -0.5],
                [0.0, 0.0, 0.25, -0.025],
            ],
        };
        assert_eq!(moved.inverse(), expected);
    }

    #[test]
    fn inverts_at_the_ends_of_the_range() {
        let tiny = Matrix::scale([1e-300, 1e-300, 1e-300]).inverse();
        assert_eq!(tiny.rows[0][0], 1.0 / 1e-300);
        let unrepresentable = Matrix::scale([1e-310, 1.0, 1.0]).inverse();
        assert_eq!(unrepresentable.rows[0][0], f64::INFINITY);
    }

    #[test]
    fn singular_matrices_have_no_inverse() {
        let flat = Matrix::scale([1.0, 0.0, 1.0]);
        assert!(flat.is_singular() && flat.inverse().rows[0][0].is_nan());
        // Rows 3 and 9 times the same vector of thirds: singular only in exact arithmetic on the
        // stored numbers.
        let v = [0.1, 0.2, 0.3];
        let dependent = Matrix {
            rows: [
                [v[0], v[1], v[2], 0.0],
                [4.0 * v[0], 4.0 * v[1], 4.0 * v[2], 0.0],
                [1.0, 2.0, 5.0, 0.0],
            ],
        };
        assert!(dependent.is_singular());
        // The third row is the sum of the others, and the products have 90 bits.
        let (a, b) = (
            [123_456_789.0, 987_654_321.0, 555_555_555.0, 0.0],
            [192_837_465.0, 564_738_291.0, 918_273_645.0, 0.0],
        );
        let sum = [a[0] + b[0], a[1] + b[1], a[2] + b[2], 0.0];
        assert!(Matrix { rows: [a, b, sum] }.is_singular());
        // The first column is 2^330 times the third; the products that tell underflow.
        let power = |exponent| 2f64.powi(exponent);
        let lost = Matrix::from_columns(
            Vector::new(power(660), power(-330), 0.0),
            Vector::new(0.0, 0.0, power(-660)),
            Vector::new(power(330), power(-660), 0.0),
            Point::default(),
        );
        assert!(lost.is_singular());
        let nearly = Matrix {
            rows: [
                [0.1, 0.2, 0.3, 0.0],
                [0.3, 0.6, 0.9, 0.0],
                [1.0, 3.0, 5.0, 0.0],
            ],
        };
        assert!(!nearly.is_singular(), "3 * 0.1 is not 0.3 in binary");
    }

    #[test]
    fn an_odd_number_of_mirrors_swaps_handedness() {
        for (factors, swaps) in [
            ([1.0, 1.0, 1.0], false),
            ([-1.0, 1.0, 1.0], true),
            ([-1.0, -2.0, 1e-200], false),
            ([-1e-200, -1e-200, -1e-200], true),
            ([-1.0, 0.0, 1.0], false),
            ([-1.0, f64::INFINITY, 1.0], false),
        ] {
            assert_eq!(
                Matrix::scale(factors).swaps_handedness(),
                swaps,
                "{factors:?}"
            );
        }
        let exchanged = Matrix {
            rows: [
                [0.0, 1.0, 0.0, 5.0],
                [1.0, 0.0, 0.0, 5.0],
                [0.0, 0.0, 1.0, 5.0],
            ],
        };
        assert!(exchanged.swaps_handedness());
    }

    #[test]
    fn products_apply_from_right_to_left() {
        let product = Matrix::translate([1.0, 2.0, 3.0]).times(&Matrix::scale([2.0, 2.0, 2.0]));
        assert_eq!(
            product.apply(Point::new(1.0, 1.0, 1.0)),
            Point::new(3.0, 4.0, 5.0)
        );
    }
}
