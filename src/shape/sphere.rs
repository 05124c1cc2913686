//! Spheres under an affine transform: the stable test in `f64`.

use crate::exact::{exponent_of, power_of_two};
use crate::geometry::{Bounds, Matrix, Point, Ray, Vector};

/// The points `world_from_object * q` with `|q| = radius`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Places and stretches the sphere.
    pub world_from_object: Matrix,
    /// In object space.
    pub radius: f64,
}

impl Sphere {
    /// Whether any ray can hit it (rule E2).
    pub fn can_be_hit(&self) -> bool {
        self.radius > 0.0
            && self.radius.is_finite()
            && self.world_from_object.is_finite()
            && !self.world_from_object.is_singular()
    }

    /// A box around it, a few units of rounding too large at most.
    pub fn bounds(&self) -> Bounds {
        let row = |k: usize| &self.world_from_object.rows[k];
        // Along an axis the ellipsoid reaches |row| * radius; five roundings of at most 2^-53 each, then one
        // more for the sum, which `next_up` and `next_down` cover.
        let reach = |k: usize| length([row(k)[0], row(k)[1], row(k)[2]]) * self.radius * (1.0 + 4.0 * f64::EPSILON);
        let low = |k: usize| (row(k)[3] - reach(k)).next_down();
        let high = |k: usize| (row(k)[3] + reach(k)).next_up();
        Bounds { low: Point::new(low(0), low(1), low(2)), high: Point::new(high(0), high(1), high(2)) }
    }

    /// The smallest positive `t` at which `ray` meets the sphere, or `None`; a tangent ray meets it.
    ///
    /// With A the adjugate of the linear part of M, o' = A(o - c), d' = A d and R = r |det M|, the sphere is
    /// |o' + t d'| = R: no division has blurred it. The discriminant is R^2 |d'|^2 - |o' x d'|^2, which keeps its
    /// digits where b^2 - ac loses them, and the roots are taken in the form that adds numbers of one sign
    /// (Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019).
    pub fn intersect(&self, ray: &Ray) -> Option<f64> {
        let (adjugate, radius) = self.scaled_adjugate();
        let centre = Point::from(self.world_from_object.column(3));
        let o = apply(&adjugate, ray.origin - centre);
        let d = apply(&adjugate, ray.direction);
        let a = d.dot(d);
        let b = o.dot(d);
        let c = o.dot(o) - radius * radius;
        let moment = o.cross(d);
        let discriminant = radius * radius * a - moment.dot(moment);
        let outside = c > 0.0;
        if outside && (b >= 0.0 || discriminant < 0.0) {
            return None;
        }
        let root = discriminant.max(0.0).sqrt();
        let t = if outside {
            c / (root - b)
        } else if b < 0.0 {
            // From within the nearer root is behind; on the surface it is 0, which does not count.
            (root - b) / a
        } else {
            -c / (b + root)
        };
        // An overflow on the way makes a NaN, which fails here.
        (t > 0.0).then_some(t)
    }

    /// The adjugate of M / 2^k and r * 2^k * |det(M / 2^k)|, with k such that the largest entry is about 1: scaling
    /// both sides of |o' + t d'| = R alike changes no answer, and keeps the products in range.
    fn scaled_adjugate(&self) -> ([Vector; 3], f64) {
        let m = &self.world_from_object;
        let largest = m.rows.iter().flat_map(|row| &row[..3]).fold(0.0f64, |max, entry| max.max(entry.abs()));
        let scale = power_of_two_near(largest);
        let column = |j: usize| Vector::from(m.column(j).map(|entry| entry / scale));
        let (x, y, z) = (column(0), column(1), column(2));
        let rows = [y.cross(z), z.cross(x), x.cross(y)];
        (rows, self.radius * scale * x.dot(rows[0]).abs())
    }
}

fn apply(rows: &[Vector; 3], v: Vector) -> Vector {
    Vector::new(rows[0].dot(v), rows[1].dot(v), rows[2].dot(v))
}

/// The length of a vector, safe from over- and underflow of the squares.
fn length(v: [f64; 3]) -> f64 {
    let scale = power_of_two_near(v.iter().fold(0.0f64, |max, entry| max.max(entry.abs())));
    let v = Vector::from(v.map(|entry| entry / scale));
    v.dot(v).sqrt() * scale
}

/// The largest power of two up to `x`; 1 where x is 0 or not finite, the least normal number for subnormals.
fn power_of_two_near(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return 1.0;
    }
    power_of_two(exponent_of(x.max(f64::MIN_POSITIVE)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(world_from_object: Matrix) -> Sphere {
        Sphere { world_from_object, radius: 1.0 }
    }

    fn along_z(x: f64, y: f64, z: f64) -> Ray {
        Ray { origin: Point::new(x, y, z), direction: Vector::new(0.0, 0.0, 1.0) }
    }

    #[test]
    fn the_nearest_positive_root_counts() {
        let sphere = unit(Matrix::translate([0.0, 0.0, 5.0]));
        assert_eq!(sphere.intersect(&along_z(0.0, 0.0, 0.0)), Some(4.0));
        assert_eq!(sphere.intersect(&along_z(0.0, 0.0, 5.0)), Some(1.0), "from the centre");
        assert_eq!(sphere.intersect(&along_z(0.0, 0.0, 5.5)), Some(0.5), "from within");
        assert_eq!(sphere.intersect(&along_z(0.0, 0.0, 4.0)), Some(2.0), "from the surface inwards");
        assert_eq!(sphere.intersect(&along_z(0.0, 0.0, 6.0)), None, "from the surface outwards");
        assert_eq!(sphere.intersect(&along_z(0.0, 0.0, 7.0)), None, "behind");
    }

    #[test]
    fn a_tangent_ray_hits() {
        let sphere = unit(Matrix::translate([0.0, 0.0, 5.0]));
        assert_eq!(sphere.intersect(&along_z(1.0, 0.0, 0.0)), Some(5.0));
        assert_eq!(sphere.intersect(&along_z(1.0f64.next_up(), 0.0, 0.0)), None);
    }

    #[test]
    fn transforms_stretch_and_mirror() {
        let stretched = unit(Matrix::translate([0.0, 0.0, 5.0]).times(&Matrix::scale([2.0, -3.0, 0.5])));
        assert_eq!(stretched.intersect(&along_z(0.0, 0.0, 0.0)), Some(4.5));
        assert_eq!(stretched.intersect(&along_z(2.0, 0.0, 0.0)), Some(5.0));
        let bounds = stretched.bounds();
        assert!(bounds.low.y < -3.0 && bounds.low.y > -3.0001 && bounds.high.z > 5.5 && bounds.high.z < 5.5001);
    }

    #[test]
    fn scales_of_any_size_work() {
        for size in [1e-300, 1e-150, 1e-20, 1e20, 1e150, 1e300] {
            let sphere = unit(Matrix::scale([size, size, size]));
            let bounds = sphere.bounds();
            assert!(sphere.can_be_hit() && bounds.low.x < -size && bounds.low.x > -1.0001 * size, "{size}");
        }
        assert!(!unit(Matrix::scale([1.0, 0.0, 1.0])).can_be_hit());
        assert!(!Sphere { radius: -1.0, ..unit(Matrix::IDENTITY) }.can_be_hit());
        assert!(!Sphere { radius: f64::NAN, ..unit(Matrix::IDENTITY) }.can_be_hit());
    }
}
