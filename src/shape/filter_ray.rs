//! A ray with what the filters need of it.

use crate::geometry::{Ray, Vector};

/// A ray, and the sizes of its direction that bounds on errors are made of.
#[derive(Debug, Clone, Copy)]
pub struct FilterRay {
    /// As the camera made it.
    pub ray: Ray,
    /// The sum of the absolute components of the direction.
    pub(super) direction_sum: f64,
    /// What [`may_underflow_below`] says of the direction.
    pub(super) least: f64,
}

impl FilterRay {
    /// Prepares `ray`.
    pub fn new(ray: &Ray) -> FilterRay {
        let Vector { x, y, z } = ray.direction.absolute();
        FilterRay { ray: *ray, direction_sum: x + y + z, least: may_underflow_below(ray.direction) }
    }
}

/// Sums of products `f . (a x b)` of which the absolute terms add up to less than this may have lost something that
/// counts to underflow.
///
/// The two products in a component of the cross product lose 2^-1075 each at most, which the factor multiplies, and the
/// product with the factor loses as much again: 2^-1072 max(1, |f|) in all, below 3e-323. At the limit the bounds leave room for
/// more than 1e-307, so that a somewhat lower one would do.
pub(super) fn may_underflow_below(factor: Vector) -> f64 {
    1e-290 * factor.largest().max(1.0)
}
