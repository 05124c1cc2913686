//! Barycentric coordinates of hits.

use super::Triangle;
use crate::exact::{UNIT_ROUNDOFF as U, may_underflow_below};
use crate::geometry::Ray;

/// The error of weights in `f64`.
const CLOSE: f64 = 1.0 / (1u64 << 32) as f64;

impl Triangle {
    /// The barycentric coordinates of the point where `ray` crosses the triangle, which it does, or
    /// nearly does. Their error is at most 2^-31; none is negative, and they add up to 1 up to a
    /// rounding.
    ///
    /// In `f64` (Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997) if
    /// that is certain, else by exact arithmetic. For a ray in the plane of the triangle they are
    /// those of the first corner.
    pub fn weights(&self, ray: &Ray) -> [f64; 3] {
        let weights = self
            .quick_weights(ray)
            .unwrap_or_else(|| self.exact_weights(ray));
        let weights = weights.map(|weight| weight.max(0.0));
        let sum = (weights[0] + weights[1]) + weights[2];
        weights.map(|weight| weight / sum)
    }

    /// A numerator and the denominator are sums of six terms with at most seven roundings each:
    /// differences in two factors, two products, the difference within the cross product, and two
    /// sums. The absolute terms take as many.
    fn quick_weights(&self, ray: &Ray) -> Option<[f64; 3]> {
        let ([a, b, c], d) = (self.0, ray.direction);
        let (ab, ac, from_a) = (b - a, c - a, ray.origin - a);
        let (across, across_terms) = (d.cross(ac), d.absolute_cross(ac));
        let determinant = ab.dot(across);
        let of_b = from_a.dot(across) / determinant;
        let of_c = d.dot(from_a.cross(ab)) / determinant;
        let terms = (ab.absolute().dot(across_terms) + from_a.absolute().dot(across_terms))
            + d.absolute().dot(from_a.absolute_cross(ab));
        let least = may_underflow_below(ab.largest().max(from_a.largest()).max(d.largest()));
        let is_close = 10.0 * U * terms <= CLOSE * determinant.abs();
        (is_close && determinant.abs() > least && terms < f64::INFINITY).then_some([
            1.0 - of_b - of_c,
            of_b,
            of_c,
        ])
    }

    fn exact_weights(&self, ray: &Ray) -> [f64; 3] {
        let edges = self.exact_edges(ray);
        let sum = &(&edges[0] + &edges[1]) + &edges[2];
        if sum.is_zero() {
            return [1.0, 0.0, 0.0];
        }
        edges.map(|edge| edge.quotient_to_f64(&sum))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, Vector};
    use proptest::prelude::*;

    fn towards(target: Point, origin: Point) -> Ray {
        Ray {
            origin,
            direction: target - origin,
        }
    }

    #[test]
    fn corners_and_edges_have_theirs() {
        let corners = [
            Point::new(0.0, 0.0, 2.0),
            Point::new(4.0, 0.0, 2.0),
            Point::new(0.0, 4.0, 2.0),
        ];
        let triangle = Triangle(corners);
        for (x, y, expected) in [
            (0.0, 0.0, [1.0, 0.0, 0.0]),
            (4.0, 0.0, [0.0, 1.0, 0.0]),
            (0.0, 4.0, [0.0, 0.0, 1.0]),
            (2.0, 1.0, [0.25, 0.5, 0.25]),
            (8.0, 0.0, [0.0, 1.0, 0.0]),
        ] {
            assert_eq!(
                triangle.weights(&towards(Point::new(x, y, 2.0), Point::new(x, y, 0.0))),
                expected
            );
        }
        let in_plane = Ray {
            origin: Point::new(-1.0, 1.0, 2.0),
            direction: Vector::new(1.0, 0.0, 0.0),
        };
        assert_eq!(triangle.weights(&in_plane), [1.0, 0.0, 0.0]);
        let sliver = Triangle([corners[0], corners[1], Point::new(2.0, 1e-300, 2.0)]);
        let [a, b, c] = sliver.weights(&towards(
            Point::new(1.0, 0.0, 2.0),
            Point::new(1.0, 0.0, 0.0),
        ));
        assert_eq!([a, b, c], [0.75, 0.25, 0.0]);
    }

    proptest! {
        #[test]
        fn quick_ones_are_close_to_exact_ones(
            corners in prop::array::uniform3(prop::array::uniform3(-1.0f64..1.0)),
            size in prop::sample::select(vec![1.0, 1e-3, 1e-6]),
            [p, q] in prop::array::uniform2(0.0f64..0.5),
            origin in prop::array::uniform3(-9.0f64..9.0),
        ) {
            let [a, b, c] = corners.map(|corner| Point::from(corner.map(|x| 3.0 + x * size)));
            let ray = towards(a + (b - a) * p + (c - a) * q, Point::from(origin));
            let triangle = Triangle([a, b, c]);
            let exact = triangle.exact_weights(&ray);
            if let Some(quick) = triangle.quick_weights(&ray) {
                prop_assert!((0..3).all(|k| (quick[k] - exact[k]).abs() <= 2.0 * CLOSE), "{quick:?} is not {exact:?}");
            }
            let weights = triangle.weights(&ray);
            prop_assert!(weights.iter().all(|weight| *weight >= 0.0) && (weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        }
    }
}
