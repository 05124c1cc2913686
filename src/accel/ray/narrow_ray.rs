//! A ray in `f32`, from a point near what it may hit.

use crate::exact::{UNIT_ROUNDOFF, exponent_of, power_of_two};
use crate::geometry::Ray;

/// A ray whose direction is scaled by a power of two and rounded to `f32`.
#[derive(Debug, Clone, Copy)]
pub(super) struct NarrowRay {
    ray: Ray,
    /// The scaled direction. The error of each component is up to 2^-24 of `size`.
    pub(super) direction: [f32; 3],
    /// The largest component of `direction`, or 1 if that is larger.
    pub(super) size: f32,
}

/// A point on a ray, or very close to it.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointOnRay {
    pub(super) point: [f64; 3],
    /// Bounds the distance from the ray on each axis.
    pub(super) error: f32,
}

/// Exceeds the loss of a product by underflow.
const UNDERFLOW: f32 = f32::MIN_POSITIVE;

impl NarrowRay {
    pub(super) fn new(ray: &Ray) -> NarrowRay {
        let scale = power_of_two(-exponent_of(ray.direction.largest()).clamp(-1000, 1000));
        let direction = ray.direction.to_array().map(|x| (x * scale) as f32);
        let [x, y, z] = direction.map(f32::abs);
        NarrowRay {
            ray: *ray,
            direction,
            size: x.max(y).max(z).max(1.0),
        }
    }

    /// The point at `t`. Each coordinate takes two roundings.
    #[inline(always)]
    pub(super) fn point_at(&self, t: f64) -> PointOnRay {
        let mut point = [0.0; 3];
        let mut terms = 0.0f64;
        for k in 0..3 {
            let step = t * self.ray.direction[k];
            point[k] = self.ray.origin[k] + step;
            terms += step.abs() + self.ray.origin[k].abs();
        }
        PointOnRay {
            point,
            error: (terms * (4.0 * UNIT_ROUNDOFF)) as f32 + UNDERFLOW,
        }
    }
}
