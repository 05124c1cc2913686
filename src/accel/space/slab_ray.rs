//! The slab test.

use super::box32::Corners;
use super::rounding::{at_or_below, larger, smaller};

/// Four roundings of 2^-24 lie between the exact quotient and a computed one, and very little more: see
/// [`super::anchor_space`]. Five units would do; in a box that is itself rounded outward, fewer would mostly do.
const SHRINK: f32 = 1.0 - 8.0 * (f32::EPSILON / 2.0);
const GROW: f32 = 1.0 + 8.0 * (f32::EPSILON / 2.0);

/// A ray in anchor space, prepared for [`SlabRay::enter`].
///
/// The face where the ray enters a slab is measured from the end of the origin's bracket that is nearer to it, and
/// divided by a direction too large; the other face from the other end, by a direction too small.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SlabRay {
    /// The corner on whose face the ray enters a slab: the low one (0), or the high one (1) where it runs towards
    /// lower coordinates.
    near_corner: [usize; 3],
    near_origin: [f32; 3],
    far_origin: [f32; 3],
    near_inverse: [f32; 3],
    far_inverse: [f32; 3],
    /// Anchor space and the scaled direction count `t` in other units: how many of them are one.
    scaled_t_per_t: f64,
}

impl SlabRay {
    /// Of which no axis is prepared. `scaled_t_per_t` tells how many units of its own `t` are one of the ray's.
    pub(crate) fn new(scaled_t_per_t: f64) -> SlabRay {
        SlabRay {
            near_corner: [0; 3],
            near_origin: [0.0; 3],
            far_origin: [0.0; 3],
            near_inverse: [0.0; 3],
            far_inverse: [0.0; 3],
            // Beyond the range of f64 nothing is culled.
            scaled_t_per_t: if scaled_t_per_t.is_normal() {
                scaled_t_per_t
            } else {
                f64::INFINITY
            },
        }
    }

    /// Prepares axis `k` for a ray from `origin`, in anchor space, along a component that is to be scaled.
    pub(crate) fn prepare_axis(
        &mut self,
        k: usize,
        origin: f64,
        direction: f64,
        direction_scale: f64,
    ) {
        // Told by the component itself: scaled down, it may underflow to 0.
        let negative = direction < 0.0;
        let sign = if negative { -1.0 } else { 1.0 };
        self.near_corner[k] = usize::from(negative);
        let scaled = (direction * direction_scale).abs();
        let (low, high) = (at_or_below(origin), -at_or_below(-origin));
        (self.near_origin[k], self.far_origin[k]) =
            if negative { (low, high) } else { (high, low) };
        let inverse = (1.0 / scaled) as f32;
        // Never infinite, or a ray that starts a rounding before a face would reach it too late.
        self.near_inverse[k] = sign * (inverse * SHRINK).min(f32::MAX);
        // Infinite where the direction is 0: then the ray never leaves.
        self.far_inverse[k] = sign * inverse * GROW;
    }

    /// The scaled `t` at which the ray enters the slab between two faces, never too late, and leaves it, never too early.
    #[inline]
    pub(crate) fn slab(&self, corners: &Corners, k: usize) -> (f32, f32) {
        // The masks spare the checks that the indices are in range.
        let (near_face, far_face) = (
            corners[self.near_corner[k] & 1][k],
            corners[!self.near_corner[k] & 1][k],
        );
        (
            (near_face - self.near_origin[k]) * self.near_inverse[k],
            (far_face - self.far_origin[k]) * self.far_inverse[k],
        )
    }

    /// The scaled `t` at which the ray enters the box, never too late, or `None` where it misses the box (Kay and
    /// Kajiya's slabs, 1986; rounding as Ize, "Robust BVH Ray Traversal", 2013).
    ///
    /// The faces are chosen by their addresses. Choosing with minima and maxima, in four lanes or for two boxes at
    /// once, took 1.1 and 1.9 times as long.
    #[inline]
    pub(crate) fn enter(&self, corners: &Corners) -> Option<f32> {
        let mut near = 0.0f32;
        let mut far = f32::INFINITY;
        for k in 0..3 {
            let (entry, exit) = self.slab(corners, k);
            near = larger(entry, near);
            far = smaller(exit, far);
        }
        // Equal where both underflow or overflow. The sum is for the compiler: it loses no hit, and compared directly the trace
        // of the dragon from nearby took 1.23 times as long.
        (near <= far + f32::MIN_POSITIVE).then_some(near)
    }

    /// `t` in scaled units, rounded as entries are: nothing at `t` or before it is entered later.
    #[inline]
    pub(crate) fn scaled_limit(&self, t: f64) -> f32 {
        (t * self.scaled_t_per_t) as f32
    }
}
