//! A ray with what the filters need of it.

use crate::exact::may_underflow_below;
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
        FilterRay {
            ray: *ray,
            direction_sum: x + y + z,
            least: may_underflow_below(ray.direction.largest()),
        }
    }
}
