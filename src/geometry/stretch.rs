//! How unevenly a matrix scales.

use super::{Matrix, Vector};
use crate::per_axis::per_axis;

/// Sweeps after which the columns are orthogonal to the last bits: three need five at most.
const SWEEPS: usize = 12;

impl Matrix {
    /// The ratio of the longest to the shortest image of vectors of length 1: 1 for a rotation or
    /// an even scale, infinite if space becomes flat. NaN if an entry is not finite.
    ///
    /// The lengths are the singular values, by Jacobi's rotations of the columns (Hestenes, 1958),
    /// which keep their precision where scales differ by many powers of ten.
    pub fn stretch(&self) -> f64 {
        let columns = per_axis(|j| Vector::from(self.column(j)));
        if !columns.iter().all(|column| column.is_finite()) {
            return f64::NAN;
        }
        // Squares of what is left neither overflow nor all vanish.
        let largest = columns
            .iter()
            .fold(0.0, |most: f64, c| most.max(c.largest()));
        if largest == 0.0 {
            return f64::INFINITY;
        }
        let scaled = |x: f64| x / largest;
        let mut columns = columns.map(|c| Vector::from(c.to_array().map(scaled)));
        for _ in 0..SWEEPS {
            for (i, j) in [(0, 1), (0, 2), (1, 2)] {
                rotate(&mut columns, i, j);
            }
        }
        let lengths = columns.map(|column| column.dot(column).sqrt());
        let longest = lengths.into_iter().fold(0.0, f64::max);
        longest / lengths.into_iter().fold(longest, f64::min)
    }
}

/// Rotates two columns so that they become orthogonal.
fn rotate(columns: &mut [Vector; 3], i: usize, j: usize) {
    let (a, b) = (columns[i], columns[j]);
    let product = a.dot(b);
    if product == 0.0 {
        return;
    }
    let half_cotangent = (b.dot(b) - a.dot(a)) / (2.0 * product);
    let tangent = half_cotangent.signum() / (half_cotangent.abs() + half_cotangent.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = cosine * tangent;
    let mixed = |p: f64, q: f64| Vector::from(per_axis(|k| p * a[k] + q * b[k]));
    (columns[i], columns[j]) = (mixed(cosine, -sine), mixed(sine, cosine));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Transform;

    #[test]
    fn tells_even_from_uneven_scales() {
        let turn = Transform::rotate(33.0, Vector::new(1.0, 2.0, -3.0)).matrix;
        let scales = [
            ([1.0, 1.0, 1.0], 1.0),
            ([-7.0, 7.0, 7.0], 1.0),
            ([1000.0, 0.001, 1000.0], 1e6),
            ([1e-200, 1e-200, 3e-200], 3.0),
            ([1e9, 1.0, 1e-9], 1e18),
        ];
        for (factors, expected) in scales {
            let scale = Matrix::scale(factors);
            for matrix in [scale, turn.times(&scale), scale.times(&turn)] {
                let found = matrix.stretch();
                // Turned first, the shortest direction is a difference of rounded numbers.
                let slack = 1e-15 * expected * expected + 1e-9 * expected;
                assert!((found - expected).abs() <= slack, "{factors:?}: {found}");
            }
        }
    }

    #[test]
    fn flat_and_broken_matrices_have_no_finite_stretch() {
        assert_eq!(Matrix::scale([0.0, 1.0, 1.0]).stretch(), f64::INFINITY);
        assert_eq!(Matrix::scale([0.0; 3]).stretch(), f64::INFINITY);
        assert!(Matrix::scale([f64::NAN, 1.0, 1.0]).stretch().is_nan());
        assert!(Matrix::scale([f64::INFINITY, 1.0, 1.0]).stretch().is_nan());
    }
}
