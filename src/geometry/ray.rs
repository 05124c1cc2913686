//! Rays.

use super::{Point, Vector};

/// The points `origin + t * direction`, `t > 0`, in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// The point at `t` = 0.
    pub origin: Point,
    /// Not normalized: its camera-space z is 1, so that `t` is the planar depth.
    pub direction: Vector,
}

impl Ray {
    /// Whether the ray can hit anything: it is finite, and not a single point (rule E1).
    pub fn can_hit(&self) -> bool {
        self.origin.is_finite() && self.direction.is_finite() && self.direction != Vector::default()
    }
}
