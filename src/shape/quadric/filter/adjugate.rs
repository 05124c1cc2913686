//! The adjugate of a matrix, with error bounds.

use crate::exact::{Approximation, UNIT_ROUNDOFF as U};
use crate::geometry::{Matrix, Vector};

/// A bound on the underflow in an entry of the adjugate: the entries of m, below 2, are off by
/// 2^-1075 if they were scaled down below the normal numbers, and each of two products loses as
/// much again, 10 * 2^-1075 in all. The first column of m, with which the determinant is computed,
/// adds 24 * 2^-1075.
const ENTRY_UNDERFLOW: f64 = f64::from_bits(1 << 5);

/// The linear part of a matrix divided by a power of two, and its adjugate, with the sums of the
/// absolute terms.
pub(super) struct Adjugate {
    /// The first column of m; with the first row of the adjugate it gives the determinant.
    pub(super) column: Vector,
    rows: [Vector; 3],
    terms: [Vector; 3],
}

impl Adjugate {
    #[inline]
    pub(super) fn new(m: &Matrix, scale: f64) -> Adjugate {
        let column = |j: usize| {
            let [x, y, z] = m.column(j);
            Vector::new(x / scale, y / scale, z / scale)
        };
        let [x, y, z] = [column(0), column(1), column(2)];
        let terms = [
            y.absolute_cross(z),
            z.absolute_cross(x),
            x.absolute_cross(y),
        ];
        Adjugate {
            column: x,
            rows: [y.cross(z), z.cross(x), x.cross(y)],
            terms,
        }
    }

    /// Row `k` times `v`, whose components may be rounded once. An entry takes two roundings, and
    /// three more follow: six units of 2^-53 of the absolute terms, and two for the roundings of
    /// the bound.
    #[inline]
    pub(super) fn row_times(&self, k: usize, v: Vector) -> Approximation {
        let size = v.absolute();
        let underflow = ENTRY_UNDERFLOW * (size.x + size.y + size.z + 1.0);
        Approximation::within(
            self.rows[k].dot(v),
            8.0 * U * self.terms[k].dot(size) + underflow,
        )
    }
}
