//! Triangles (rule E1).

use crate::exact::{ExactVector, Root};
use crate::geometry::Ray;
use crate::shape::Triangle;
use std::cmp::Ordering::{Greater, Less};

/// Rule E1 by the plane: the point where the ray crosses it must lie on the inner side of all three
/// edges.
pub(super) fn meet(triangle: &Triangle, ray: &Ray) -> Option<Root> {
    if !triangle.0.iter().all(|corner| corner.is_finite()) {
        return None;
    }
    let corners = triangle.0.map(ExactVector::from);
    let [a, b, c] = &corners;
    let (origin, direction) = (
        ExactVector::from(ray.origin),
        ExactVector::from(ray.direction),
    );
    let normal = b.minus(a).cross(&c.minus(a));
    let slope = normal.dot(&direction);
    if slope.is_zero() {
        return None;
    }
    let height = normal.dot(&a.minus(&origin));
    if (&height * &slope).sign() != Greater {
        return None;
    }
    // The crossing point times the slope.
    let point = origin.times(&slope).plus(&direction.times(&height));
    let is_inside = |k: usize| {
        let (from, to) = (&corners[k], &corners[(k + 1) % 3]);
        let side = normal.dot(&to.minus(from).cross(&point.minus(&from.times(&slope))));
        (&side * &slope).sign() != Less
    };
    (0..3).all(is_inside).then(|| Root::ratio(height, slope))
}
