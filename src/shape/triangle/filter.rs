//! The triangle test in `f64`, with error bounds.
//!
//! With u = 2^-53 and corners v relative to the ray's origin, the edge functions are e0 = d . (v1 x
//! v2) and so on. A computed one is a sum of six terms d v v, each with at most seven roundings:
//! the differences in both v, two products, the difference within the cross product, and two sums.
//! So its error is below 7u(1 + 8u) P, where P is the sum of the absolute terms; 8u P leaves room
//! for the roundings in P, which is computed from rounded v (Shewchuk, "Adaptive Precision
//! Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, bounds its first stage in
//! the same way). Two triangles that share an edge compute the same numbers with opposite signs.

use super::Triangle;
use crate::exact::{Approximation, Bracket, UNIT_ROUNDOFF as U, may_underflow_below};
use crate::geometry::Vector;
use crate::shape::{FilterRay, FilterResult};

/// The error of an edge function, relative to its absolute terms.
const EDGE_ERROR: f64 = 8.0 * U;

/// The errors of the two sums whose quotient is `t`. The terms of one take eight roundings: the
/// differences in all three factors, two products, the difference within the cross product, and two
/// sums; those of the other seven. The absolute terms take as many.
const PLANE_ERROR: f64 = 10.0 * U;

/// Where the ray crosses the triangle's plane.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Inside,
    Outside,
    Unsure,
}

impl Triangle {
    /// Whether and where `ray` crosses the closed triangle, as far as `f64` can decide (rule E1).
    #[inline]
    pub fn filter(&self, ray: &FilterRay) -> FilterResult {
        let d = ray.ray.direction;
        let corners = self.0.map(|corner| corner - ray.ray.origin);
        let [v0, v1, v2] = corners;
        let edges = [
            d.dot(v1.cross(v2)),
            d.dot(v2.cross(v0)),
            d.dot(v0.cross(v1)),
        ];
        let error = edge_error(most_edge_terms(&corners, ray), ray);
        let mut side = side_of(&edges, &[error; 3]);
        if side == Side::Unsure {
            side = side_of(&edges, &close_edge_errors(&corners, ray));
        }
        match side {
            Side::Outside => FilterResult::Miss,
            Side::Inside => self.place(ray),
            Side::Unsure => FilterResult::Unsure,
        }
    }

    /// A bracket of the `t` of a ray that is known to cross the triangle.
    pub fn t_of_hit(&self, ray: &FilterRay) -> Option<Bracket> {
        match self.place(ray) {
            FilterResult::Hit(t) => Some(t),
            _ => None,
        }
    }

    /// The result for a ray that certainly crosses the plane within the triangle: t = n . (a - o) /
    /// (n . d).
    fn place(&self, ray: &FilterRay) -> FilterResult {
        let [height, slope] = self.height_and_slope(ray);
        let t = height.over(slope).bracket();
        if t.low > 0.0 {
            FilterResult::Hit(t)
        } else if t.high <= 0.0 {
            FilterResult::Miss
        } else {
            FilterResult::Unsure
        }
    }

    /// n . (a - o) and n . d, with n = ab x ac.
    fn height_and_slope(&self, ray: &FilterRay) -> [Approximation; 2] {
        let [a, b, c] = self.0;
        let (ab, ac) = (b - a, c - a);
        let (normal, normal_terms) = (ab.cross(ac), ab.absolute_cross(ac));
        let along = |v: Vector, least: f64| {
            let terms = normal_terms.dot(v.absolute());
            Approximation::within(normal.dot(v), error_of(PLANE_ERROR, terms, least))
        };
        let to_corner = a - ray.ray.origin;
        [
            along(to_corner, may_underflow_below(to_corner.largest())),
            along(ray.ray.direction, ray.least),
        ]
    }
}

/// The error of a sum whose absolute terms add up to at most `terms`: infinite if underflow may
/// have lost something that matters, or if something overflowed. Overflow on the way to a sum also
/// overflows on the way to the terms, which are then infinite or NaN.
#[inline]
fn error_of(units: f64, terms: f64, least: f64) -> f64 {
    if terms > least {
        units * terms
    } else {
        f64::INFINITY
    }
}

/// A bound on the absolute terms of an edge function: no product of two coordinates is larger than
/// the square of the largest, and a component of a cross product has two. Infinite if that
/// component may be.
#[inline]
fn most_edge_terms([v0, v1, v2]: &[Vector; 3], ray: &FilterRay) -> f64 {
    let extent = v0.largest().max(v1.largest()).max(v2.largest());
    ray.direction_sum * (2.0 * extent * extent)
}

/// The error of an edge function whose absolute terms add up to at most `terms`.
#[inline]
fn edge_error(terms: f64, ray: &FilterRay) -> f64 {
    error_of(EDGE_ERROR, terms, ray.least)
}

/// Bounds from the terms of each edge function, for rays that the common bound leaves undecided.
#[cold]
fn close_edge_errors(corners: &[Vector; 3], ray: &FilterRay) -> [f64; 3] {
    let [v0, v1, v2] = corners;
    let error = |a: &Vector, b: &Vector| {
        edge_error(ray.ray.direction.absolute().dot(a.absolute_cross(*b)), ray)
    };
    [error(v1, v2), error(v2, v0), error(v0, v1)]
}

/// The errors are above 0 and never reached, so an edge function that equals one is certain, too.
#[inline]
fn side_of(edges: &[f64; 3], errors: &[f64; 3]) -> Side {
    let positive = [0, 1, 2].map(|k| edges[k] > errors[k]);
    let negative = [0, 1, 2].map(|k| edges[k] < -errors[k]);
    let (any_positive, all_positive) = (
        positive[0] | positive[1] | positive[2],
        positive[0] & positive[1] & positive[2],
    );
    let (any_negative, all_negative) = (
        negative[0] | negative[1] | negative[2],
        negative[0] & negative[1] & negative[2],
    );
    if any_positive & any_negative {
        Side::Outside
    } else if all_positive | all_negative {
        Side::Inside
    } else {
        Side::Unsure
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Dyadic, ExactVector};
    use crate::geometry::{Point, Ray};
    use proptest::prelude::*;
    use std::cmp::Ordering;

    /// Numbers with all their bits, whole ones, and ones of other sizes.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            4 => -1.0f64..1.0,
            2 => (-3i32..4).prop_map(f64::from),
            1 => (-1.0f64..1.0, -500i32..460).prop_map(|(x, exponent)| x * 2f64.powi(exponent)),
        ]
    }

    /// Of one size, a third of the time, so that products of two or three come near either end of
    /// the range.
    fn vector() -> impl Strategy<Value = Vector> {
        let size = prop::sample::select(vec![-620, -530, -340, 0, 300, 330, 500]);
        let of_one_size = (prop::array::uniform3(-1.0f64..1.0), size)
            .prop_map(|(v, exponent): ([f64; 3], i32)| Vector::from(v) * 2f64.powi(exponent));
        prop_oneof![2 => prop::array::uniform3(coordinate()).prop_map(Vector::from), 1 => of_one_size]
    }

    fn exact(v: Vector) -> ExactVector {
        ExactVector::from(v)
    }

    /// The cross product overflows where it hardly counts: the direction is short, and nearly
    /// across that component.
    #[test]
    fn an_overflow_in_the_cross_product_is_noticed() {
        let (large, d) = (1.2e154, Vector::new(1e-50, 1e-20, 0.0));
        let ray = FilterRay::new(&Ray {
            origin: Point::default(),
            direction: d,
        });
        let [v, w] = [
            Vector::new(0.0, large, -large),
            Vector::new(0.9 * large, large, large),
        ];
        assert_eq!(d.dot(v.cross(w)), f64::INFINITY, "it is below 0 in truth");
        assert!(exact(d).dot(&exact(v).cross(&exact(w))).sign() == Ordering::Less);
        assert_eq!(
            edge_error(most_edge_terms(&[v, w, w], &ray), &ray),
            f64::INFINITY
        );
        assert_eq!(close_edge_errors(&[v, w, w], &ray)[2], f64::INFINITY);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// Both bounds on the edge functions hold for what is computed from rounded differences.
        #[test]
        fn edge_functions_stay_within_their_bounds(origin in vector(), a in vector(), b in vector(), d in vector()) {
            let ray = FilterRay::new(&Ray { origin: Point::default() + origin, direction: d });
            let [v, w] = [a, b].map(|v| (Point::default() + v) - ray.ray.origin);
            let edge = d.dot(v.cross(w));
            let [exact_v, exact_w] = [a, b].map(|v| exact(v).minus(&exact(origin)));
            let meant = exact(d).dot(&exact_v.cross(&exact_w));
            let [_, _, close] = close_edge_errors(&[v, w, Vector::default()], &ray);
            let common = edge_error(most_edge_terms(&[v, w, v], &ray), &ray);
            for error in [close, common] {
                if error.is_finite() {
                    let off = (&Dyadic::from(edge) - &meant).abs();
                    prop_assert!(off <= Dyadic::from(error), "{} > {error}", off.to_f64());
                }
            }
        }

        #[test]
        fn heights_and_slopes_stay_within_their_bounds(
            corners in prop::array::uniform3(vector()),
            origin in vector(),
            d in vector(),
        ) {
            let triangle = Triangle(corners.map(|corner| Point::default() + corner));
            let ray = FilterRay::new(&Ray { origin: Point::default() + origin, direction: d });
            let [a, b, c] = corners.map(exact);
            let normal = b.minus(&a).cross(&c.minus(&a));
            let meant = [normal.dot(&a.minus(&exact(origin))), normal.dot(&exact(d))];
            for (found, meant) in triangle.height_and_slope(&ray).iter().zip(meant) {
                let Bracket { low, high } = found.bracket();
                prop_assert!(!low.is_finite() || Dyadic::from(low) <= meant);
                prop_assert!(!high.is_finite() || Dyadic::from(high) >= meant);
            }
        }

        /// Rays made to cross the plane of the triangle in its middle: whatever the filter says of
        /// them is so.
        #[test]
        fn verdicts_are_right(origin in vector(), corners in prop::array::uniform3(vector()), aside in -2.0f64..2.0) {
            let triangle = Triangle(corners.map(|corner| Point::default() + corner));
            prop_assume!(triangle.can_be_hit());
            let [a, b, c] = corners;
            let target = |k: usize| (a[k] + b[k] + c[k]) / 3.0 + aside * (a[k] - b[k]);
            let origin = Point::default() + origin;
            let ray = Ray { origin, direction: Point::new(target(0), target(1), target(2)) - origin };
            prop_assume!(ray.can_hit());
            match (triangle.filter(&FilterRay::new(&ray)), triangle.exact(&ray)) {
                (FilterResult::Unsure, _) | (FilterResult::Miss, None) => {}
                (FilterResult::Hit(bracket), Some(t)) => {
                    prop_assert!(t.compare_with(&Dyadic::from(bracket.low)) != Ordering::Less);
                    prop_assert!(bracket.high == f64::INFINITY || t.compare_with(&Dyadic::from(bracket.high)) != Ordering::Greater);
                }
                (verdict, t) => prop_assert!(false, "{verdict:?}, but {t:?}"),
            }
        }
    }
}
