//! A ray with the sizes that the filters need.

use crate::exact::may_underflow_below;
use crate::geometry::{Ray, Vector};

/// A ray, and the sizes of its direction, from which the filters bound errors.
#[derive(Debug, Clone, Copy)]
pub struct FilterRay {
    /// The ray of the camera.
    pub ray: Ray,
    /// The sum of the absolute components of the direction.
    pub(super) direction_sum: f64,
    /// [`may_underflow_below`] of the direction.
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
