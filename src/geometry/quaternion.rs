//! Rotations as unit quaternions (rule R10).

use super::Vector;

/// Quaternions with a larger dot product are mixed linearly.
const ALMOST_EQUAL: f64 = 0.9995;

/// A rotation: x, y and z of the axis times the sine of half the angle, and its cosine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Quaternion([f64; 4]);

impl Quaternion {
    /// The rotation with these columns (K. Shoemake, "Animating Rotation with Quaternion Curves",
    /// 1985).
    pub(super) fn of_rotation(columns: &[Vector; 3]) -> Quaternion {
        let m = |row: usize, column: usize| columns[column][row];
        let trace = (m(0, 0) + m(1, 1)) + m(2, 2);
        if trace > 0.0 {
            let root = (trace + 1.0).sqrt();
            let s = 0.5 / root;
            return Quaternion([
                (m(2, 1) - m(1, 2)) * s,
                (m(0, 2) - m(2, 0)) * s,
                (m(1, 0) - m(0, 1)) * s,
                0.5 * root,
            ]);
        }
        // The largest of x, y and z first; of equal ones the first.
        let mut i = usize::from(m(1, 1) > m(0, 0));
        if m(2, 2) > m(i, i) {
            i = 2;
        }
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let root = ((m(i, i) - (m(j, j) + m(k, k))) + 1.0).sqrt();
        let s = 0.5 / root;
        let mut parts = [0.0; 4];
        parts[i] = 0.5 * root;
        parts[j] = (m(j, i) + m(i, j)) * s;
        parts[k] = (m(k, i) + m(i, k)) * s;
        parts[3] = (m(k, j) - m(j, k)) * s;
        Quaternion(parts)
    }

    /// The columns of the rotation.
    pub(super) fn columns(&self) -> [Vector; 3] {
        let [x, y, z, w] = self.0;
        [
            Vector::new(
                1.0 - 2.0 * (y * y + z * z),
                2.0 * (x * y + z * w),
                2.0 * (x * z - y * w),
            ),
            Vector::new(
                2.0 * (x * y - z * w),
                1.0 - 2.0 * (x * x + z * z),
                2.0 * (y * z + x * w),
            ),
            Vector::new(
                2.0 * (x * z + y * w),
                2.0 * (y * z - x * w),
                1.0 - 2.0 * (x * x + y * y),
            ),
        ]
    }

    /// The rotation at `time`, from 0 for this one to 1 for `end`, at an even speed and by the
    /// shorter way.
    pub(super) fn interpolated(&self, end: &Quaternion, time: f64) -> Quaternion {
        let cosine = self.dot(end);
        let (end, cosine) = match cosine < 0.0 {
            true => (Quaternion(end.0.map(|part| -part)), -cosine),
            false => (*end, cosine),
        };
        if cosine > ALMOST_EQUAL {
            return self.mixed(1.0 - time, &end, time).normalized();
        }
        let angle = libm::acos(cosine) * time;
        let across = end.mixed(1.0, self, -cosine).normalized();
        self.mixed(libm::cos(angle), &across, libm::sin(angle))
    }

    fn dot(&self, other: &Quaternion) -> f64 {
        let (a, b) = (self.0, other.0);
        ((a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]) + a[3] * b[3]
    }

    /// The sum of both, with weights.
    fn mixed(&self, weight: f64, other: &Quaternion, other_weight: f64) -> Quaternion {
        let (a, b) = (self.0, other.0);
        Quaternion([0, 1, 2, 3].map(|k: usize| weight * a[k] + other_weight * b[k]))
    }

    fn normalized(&self) -> Quaternion {
        let length = self.dot(self).sqrt();
        Quaternion(self.0.map(|part| part / length))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Transform;

    #[test]
    fn rotations_go_there_and_back() {
        for angle in [0.0, 1.0, 90.0, 179.0, 180.0, 181.0, 300.0] {
            for axis in [
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, 0.0, 1.0],
                [1.0, -2.0, 0.5],
            ] {
                let matrix = Transform::rotate(angle, Vector::from(axis)).matrix;
                let columns = [0, 1, 2].map(|j| Vector::from(matrix.column(j)));
                let back = Quaternion::of_rotation(&columns).columns();
                let off = |j: usize, k: usize| (back[j][k] - columns[j][k]).abs();
                let is_close = (0..9).all(|k| off(k / 3, k % 3) < 1e-15);
                assert!(is_close, "{angle} {axis:?}");
            }
        }
    }
}
