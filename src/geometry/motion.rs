//! A transform between two others, as pbrt interpolates them (rule R10).
//!
//! Each is divided into a translation, a rotation and a stretch (K. Shoemake and T. Duff, "Matrix
//! Animation and Polar Decomposition", 1992), and these are interpolated apart.

use super::quaternion::Quaternion;
use super::{Matrix, Vector};
use crate::exact::{exponent_of, times_power_of_two};
use crate::per_axis::per_axis;

/// The most steps towards the rotation.
const MOST_STEPS: u32 = 100;

/// A step that changes no entry by more than this is the last one.
const SMALL: f64 = 1.0 / (1u64 << 40) as f64;

/// The columns of a linear map.
type Columns = [Vector; 3];

impl Matrix {
    /// The transform at `time`, from 0 for this one to 1 for `end`: exactly these at both ends, and
    /// if they are equal. A singular one has no rotation; then entries are interpolated one by one.
    pub fn interpolated(&self, end: &Matrix, time: f64) -> Matrix {
        if time <= 0.0 || self == end {
            return *self;
        }
        if time >= 1.0 {
            return *end;
        }
        let between = |a: f64, b: f64| (1.0 - time) * a + time * b;
        let linear = match (Parts::of(self), Parts::of(end)) {
            (Some(start), Some(end)) => start.interpolated(&end, time),
            _ => per_axis(|j| {
                let (a, b) = (self.column(j), end.column(j));
                Vector::from(per_axis(|k| between(a[k], b[k])))
            }),
        };
        let (a, b) = (self.column(3), end.column(3));
        let offset = per_axis(|k| between(a[k], b[k]));
        let [x, y, z] = linear;
        Matrix::from_columns(x, y, z, offset.into())
    }
}

/// A linear map as a rotation after a stretch.
struct Parts {
    rotation: Quaternion,
    stretch: Columns,
}

impl Parts {
    /// `None` if the map is singular or not finite.
    fn of(matrix: &Matrix) -> Option<Parts> {
        let map: Columns = per_axis(|j| Vector::from(matrix.column(j)));
        let largest = map.map(Vector::largest).into_iter().fold(0.0, f64::max);
        if !matrix.is_finite() || largest == 0.0 {
            return None;
        }
        // The rotation does not depend on the size, but the number of steps does.
        let exponent = exponent_of(largest);
        let sized = |x: f64| times_power_of_two(x, -exponent);
        let rotation = nearest_rotation(map.map(|v| Vector::from(v.to_array().map(sized))))?;
        // A map that mirrors is a rotation after a stretch that mirrors.
        let is_mirrored = rotation[0].dot(rotation[1].cross(rotation[2])) < 0.0;
        let rotation = rotation.map(|v| if is_mirrored { -v } else { v });
        let stretch = map.map(|v| Vector::from(rotation.map(|axis| axis.dot(v))));
        Some(Parts {
            rotation: Quaternion::of_rotation(&rotation),
            stretch,
        })
    }

    fn interpolated(&self, end: &Parts, time: f64) -> Columns {
        let rotation = self.rotation.interpolated(&end.rotation, time).columns();
        let [x, y, z] = rotation;
        per_axis(|j| {
            let (a, b) = (self.stretch[j], end.stretch[j]);
            let s = per_axis(|k| (1.0 - time) * a[k] + time * b[k]);
            let component = |k: usize| (x[k] * s[0] + y[k] * s[1]) + z[k] * s[2];
            Vector::new(component(0), component(1), component(2))
        })
    }
}

/// The orthogonal map nearest to `map`, by Newton's method: the mean of a map and its transposed
/// inverse, again and again. `None` if an inverse is not finite.
fn nearest_rotation(mut map: Columns) -> Option<Columns> {
    for _ in 0..MOST_STEPS {
        let [x, y, z] = map;
        let cofactors = [y.cross(z), z.cross(x), x.cross(y)];
        let determinant = x.dot(cofactors[0]);
        let mean = |j: usize| {
            let entry = |k: usize| 0.5 * (map[j][k] + cofactors[j][k] / determinant);
            Vector::new(entry(0), entry(1), entry(2))
        };
        let next = [mean(0), mean(1), mean(2)];
        if !next.iter().all(|v| v.is_finite()) {
            return None;
        }
        let entries = |map: &Columns| map.map(Vector::to_array).into_iter().flatten();
        let changes = entries(&next)
            .zip(entries(&map))
            .map(|(a, b)| (a - b).abs());
        let change = changes.fold(0.0, f64::max);
        map = next;
        if change <= SMALL {
            break;
        }
    }
    Some(map)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, Transform};
    use proptest::prelude::*;

    fn is_close(a: &Matrix, b: &Matrix, size: f64) -> bool {
        let pairs = a.rows.iter().flatten().zip(b.rows.iter().flatten());
        pairs
            .into_iter()
            .all(|(a, b)| (a - b).abs() <= 1e-12 * size)
    }

    #[test]
    fn the_ends_are_exact() {
        let a = Transform::rotate(17.0, Vector::new(1.0, 2.0, 3.0)).matrix;
        let b = Matrix::translate([0.1, 0.2, 0.3]).times(&Matrix::scale([2.0, -3.0, 0.1]));
        assert_eq!((a.interpolated(&b, 0.0), a.interpolated(&b, 1.0)), (a, b));
        assert_eq!(b.interpolated(&b, 0.3), b);
    }

    #[test]
    fn a_turn_goes_on_evenly() {
        for (from, to, time, expected) in [
            (0.0, 90.0, 0.5, 45.0),
            (0.0, 90.0, 1.0 / 3.0, 30.0),
            (10.0, 170.0, 0.25, 50.0),
            (0.0, 1.0, 0.5, 0.5),
            // The shorter way.
            (0.0, 270.0, 0.5, -45.0),
        ] {
            let turn = |angle| Transform::rotate(angle, Vector::new(0.3, -0.5, 0.9)).matrix;
            let found = turn(from).interpolated(&turn(to), time);
            assert!(
                is_close(&found, &turn(expected), 1.0),
                "{from} to {to}: {found:?}"
            );
        }
    }

    #[test]
    fn translations_and_scales_are_interpolated_apart() {
        let a = Matrix::translate([1.0, 2.0, 3.0]).times(&Matrix::scale([1.0, 2.0, 1e-3]));
        let b = Matrix::translate([5.0, 2.0, -1.0]).times(&Matrix::scale([3.0, 2.0, 3e-3]));
        let expected = Matrix::translate([2.0, 2.0, 2.0]).times(&Matrix::scale([1.5, 2.0, 1.5e-3]));
        assert!(is_close(&a.interpolated(&b, 0.25), &expected, 1.0));
    }

    #[test]
    fn singular_ends_are_interpolated_entry_by_entry() {
        let flat = Matrix::scale([2.0, 0.0, 4.0]);
        let found = flat.interpolated(&Matrix::IDENTITY, 0.5);
        assert_eq!(found, Matrix::scale([1.5, 0.5, 2.5]));
        let broken = Matrix::scale([f64::NAN, 1.0, 1.0]);
        assert!(broken.interpolated(&flat, 0.5).rows[0][0].is_nan());
        assert_eq!(broken.interpolated(&flat, 0.5).rows[2][2], 2.5);
    }

    proptest! {
        /// A matrix is the product of its parts, whatever it is.
        #[test]
        fn parts_make_up_the_whole(
            rows in prop::array::uniform3(prop::array::uniform4(-1.0f64..1.0)),
            exponent in prop::sample::select(vec![-900, -30, 0, 30, 900]),
        ) {
            let size = times_power_of_two(1.0, exponent);
            let matrix = Matrix { rows: rows.map(|row| row.map(|x| x * size)) };
            prop_assume!(Matrix { rows }.exact_adjugate().1.to_f64().abs() > 1e-3);
            let parts = Parts::of(&matrix).unwrap();
            let [x, y, z] = parts.interpolated(&parts, 0.5);
            let whole = Matrix::from_columns(x, y, z, matrix.column(3).into());
            prop_assert!(is_close(&whole, &matrix, size), "{whole:?} is not {matrix:?}");
            // The stretch is symmetric.
            for (i, j) in [(0, 1), (0, 2), (1, 2)] {
                prop_assert!((parts.stretch[i][j] - parts.stretch[j][i]).abs() <= 1e-12 * size);
            }
        }

        /// Mirrored ends stay mirrored on the way, and nothing collapses.
        #[test]
        fn mirrored_motions_stay_mirrored(
            angles in prop::array::uniform2(-170.0f64..170.0),
            axis in prop::array::uniform3(-1.0f64..1.0),
            time in 0.01f64..0.99,
        ) {
            let axis = Vector::from(axis);
            prop_assume!(axis.largest() > 0.1);
            let mirror = Matrix::scale([-2.0, 2.0, 2.0]);
            let end = |angle| Transform::rotate(angle, axis).matrix.times(&mirror);
            let found = end(angles[0]).interpolated(&end(angles[1]), time);
            prop_assert!(found.swaps_handedness());
            let moved = found.apply(Point::new(0.6, 0.0, 0.8)) - Point::default();
            prop_assert!((moved.dot(moved).sqrt() - 2.0).abs() < 1e-12);
        }
    }
}
