//! Triangles: the watertight test in `f64`, and which triangles can be hit at all.

use crate::exact::Dyadic;
use crate::geometry::{Bounds, Point, Ray, Vector};

/// Three corners in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle(pub [Point; 3]);

/// Unit of rounding of `f64`: half the distance from 1 to the next number.
const U: f64 = f64::EPSILON / 2.0;

impl Triangle {
    /// The box around the corners.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.0)
    }

    /// Whether any ray can hit it: all corners finite, and an area that is not exactly 0 (rule E1).
    pub fn can_be_hit(&self) -> bool {
        let [a, b, c] = self.0;
        if !self.0.iter().all(|corner| corner.is_finite()) || a == b || b == c || c == a {
            return false;
        }
        let (u, v) = (b - a, c - a);
        // A component of the cross product is off by at most the roundings of two differences, one product and
        // one sum, 4U of its terms' absolute sum; 8U is ample. Below 1e-290 bits may be lost to underflow.
        let surely_not_zero = |p: f64, q: f64| (p - q).abs() > 8.0 * U * (p.abs() + q.abs()) + 1e-290;
        surely_not_zero(u.y * v.z, u.z * v.y)
            || surely_not_zero(u.z * v.x, u.x * v.z)
            || surely_not_zero(u.x * v.y, u.y * v.x)
            || self.has_exact_area()
    }

    fn has_exact_area(&self) -> bool {
        let [a, b, c] = self.0.map(|corner| corner.to_array().map(Dyadic::from));
        let minus = |p: &[Dyadic; 3]| -> [Dyadic; 3] { std::array::from_fn(|k| p[k].clone() - a[k].clone()) };
        let (u, v) = (minus(&b), minus(&c));
        (0..3).any(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            !(&u[i] * &v[j] - &u[j] * &v[i]).is_zero()
        })
    }

    /// The `t` at which `ray` crosses the closed triangle, or `None`.
    ///
    /// The signs of the three edge functions decide, each `d . (v1 x v2)` with the corners relative to the ray's
    /// origin. Two triangles that share an edge compute the same numbers with opposite signs, so no ray passes
    /// between them (Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", 2013; here without the
    /// shear, in `f64`). `t` is the mean of the corners' `t` along the largest axis of the direction, weighted by
    /// the edge functions. A ray in the plane of the triangle makes all three 0 and misses.
    pub fn intersect(&self, ray: &Ray) -> Option<f64> {
        let d = ray.direction;
        let [v0, v1, v2] = self.0.map(|corner| corner - ray.origin);
        let e0 = d.dot(v1.cross(v2));
        let e1 = d.dot(v2.cross(v0));
        let e2 = d.dot(v0.cross(v1));
        let inside = (e0 >= 0.0 && e1 >= 0.0 && e2 >= 0.0) || (e0 <= 0.0 && e1 <= 0.0 && e2 <= 0.0);
        let sum = e0 + e1 + e2;
        if !inside || sum == 0.0 {
            return None;
        }
        let t = weighted_mean([v0, v1, v2], [e0 / sum, e1 / sum, e2 / sum], d);
        // An overflow on the way makes a NaN, which fails here.
        (t > 0.0).then_some(t)
    }
}

fn weighted_mean(corners: [Vector; 3], weights: [f64; 3], direction: Vector) -> f64 {
    let k = direction.largest_axis();
    (weights[0] * corners[0][k] + weights[1] * corners[1][k] + weights[2] * corners[2][k]) / direction[k]
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIGHT: Triangle = Triangle([Point::new(0.0, 0.0, 2.0), Point::new(4.0, 0.0, 2.0), Point::new(0.0, 4.0, 2.0)]);

    fn along_z(x: f64, y: f64) -> Ray {
        Ray { origin: Point::new(x, y, 0.0), direction: Vector::new(0.0, 0.0, 0.5) }
    }

    #[test]
    fn is_a_closed_set() {
        for (x, y) in [(0.0, 0.0), (4.0, 0.0), (0.0, 4.0), (2.0, 2.0), (2.0, 0.0), (1.0, 1.0)] {
            assert_eq!(RIGHT.intersect(&along_z(x, y)), Some(4.0), "({x}, {y})");
        }
        for (x, y) in [(-1e-300, 0.0), (2.0, 2.0000000000000004), (5.0, -1.0)] {
            assert_eq!(RIGHT.intersect(&along_z(x, y)), None, "({x}, {y})");
        }
    }

    #[test]
    fn both_sides_count_and_the_way_back_does_not() {
        let [a, b, c] = RIGHT.0;
        assert_eq!(Triangle([a, c, b]).intersect(&along_z(1.0, 1.0)), Some(4.0));
        let behind = Ray { origin: Point::new(1.0, 1.0, 3.0), ..along_z(1.0, 1.0) };
        assert_eq!(RIGHT.intersect(&behind), None);
        let on_it = Ray { origin: Point::new(1.0, 1.0, 2.0), ..along_z(1.0, 1.0) };
        assert_eq!(RIGHT.intersect(&on_it), None);
    }

    #[test]
    fn a_ray_in_its_plane_misses() {
        let ray = Ray { origin: Point::new(-1.0, 1.0, 2.0), direction: Vector::new(1.0, 0.0, 0.0) };
        assert_eq!(RIGHT.intersect(&ray), None);
    }

    #[test]
    fn knows_what_can_never_be_hit() {
        let point = |x: f64| Point::new(x, 3.0 * x, 7.0 * x);
        assert!(RIGHT.can_be_hit());
        assert!(!Triangle([point(1.0), point(1.0), point(2.0)]).can_be_hit(), "two corners in one place");
        assert!(!Triangle([point(1.0), point(2.0), point(4.0)]).can_be_hit(), "collinear");
        let bent = Point::new(2.0, 6.0, f64::from_bits(14f64.to_bits() + 1));
        assert!(Triangle([point(1.0), bent, point(4.0)]).can_be_hit(), "collinear but for one bit");
        assert!(!Triangle([point(1.0), point(2.0), Point::new(0.0, f64::NAN, 0.0)]).can_be_hit());
        let tiny = |x: f64, y: f64| Point::new(x * 1e-310, y * 1e-310, 1e-310);
        assert!(Triangle([tiny(0.0, 0.0), tiny(1.0, 0.0), tiny(0.0, 1.0)]).can_be_hit(), "products underflow");
    }
}
