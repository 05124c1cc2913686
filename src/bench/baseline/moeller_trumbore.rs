//! "Fast, minimum storage ray/triangle intersection" (Moeller and Trumbore, 1997).

use super::ray32::{Corners, Ray32, minus};
use crate::shape::vector32::{cross, dot};

/// As in the paper for two-sided triangles, but without its epsilon, which makes small triangles
/// vanish.
#[inline]
pub(super) fn intersect(ray: &Ray32, [a, b, c]: &Corners) -> Option<f32> {
    let (ab, ac) = (minus(*b, *a), minus(*c, *a));
    let across = cross(ray.direction, ac);
    let determinant = dot(ab, across);
    if determinant == 0.0 {
        return None;
    }
    let inverse = 1.0 / determinant;
    let from_a = minus(ray.origin, *a);
    let u = dot(from_a, across) * inverse;
    if !(0.0..=1.0).contains(&u) {
        return None;
    }
    let along = cross(from_a, ab);
    let v = dot(ray.direction, along) * inverse;
    if v < 0.0 || u + v > 1.0 {
        return None;
    }
    let t = dot(ac, along) * inverse;
    (t > 0.0).then_some(t)
}
