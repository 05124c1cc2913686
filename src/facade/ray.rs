//! A ray of the user.

use crate::geometry;

/// The points `origin + t * direction` with `t > 0`, in world space.
///
/// `direction` need not be normalized: its length is the unit of [`Hit::t`](crate::Hit::t). A ray
/// with a number that is not finite, or with a direction of zeros, hits nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ray {
    /// The point at `t` = 0.
    pub origin: [f64; 3],
    /// The direction, of any length above 0.
    pub direction: [f64; 3],
}

impl Ray {
    /// The ray from `origin` along `direction`.
    pub fn new(origin: [f64; 3], direction: [f64; 3]) -> Ray {
        Ray { origin, direction }
    }

    /// The ray as the rest of the library has it.
    pub(super) fn in_world(&self) -> geometry::Ray {
        geometry::Ray {
            origin: self.origin.into(),
            direction: self.direction.into(),
        }
    }
}

impl From<geometry::Ray> for Ray {
    fn from(ray: geometry::Ray) -> Ray {
        Ray {
            origin: ray.origin.to_array(),
            direction: ray.direction.to_array(),
        }
    }
}
