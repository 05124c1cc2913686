//! The slab test of a ray against boxes.

use super::box32::Corners;
use super::rounding::{at_or_below, larger, smaller};

/// Four roundings of 2^-24, and very little more, lie between the exact quotient and a computed
/// one: see [`super::anchor_space`]. Five units would be enough, for boxes that are rounded outward
/// mostly fewer.
const SHRINK: f32 = 1.0 - 8.0 * (f32::EPSILON / 2.0);
const GROW: f32 = 1.0 + 8.0 * (f32::EPSILON / 2.0);

/// A ray in anchor space, prepared for [`SlabRay::enter`].
///
/// The face where the ray enters a slab is measured from the end of the origin's bracket that is
/// nearer to it, and divided by a direction that is too large; the other face from the other end,
/// by one that is too small.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SlabRay {
    /// The corner on whose face the ray enters a slab: the low one (0), or the high one (1) if the
    /// ray runs towards lower coordinates.
    pub(crate) near_corner: [usize; 3],
    /// oh of the proof in [`super::anchor_space`], or ol if the ray runs towards lower coordinates.
    pub(crate) near_origin: [f32; 3],
    /// The other end of the bracket.
    pub(crate) far_origin: [f32; 3],
    /// The reciprocal of D, rounded down in magnitude, or up for `far_inverse`.
    pub(crate) near_inverse: [f32; 3],
    pub(crate) far_inverse: [f32; 3],
    /// Scaled units of `t`, in anchor space with the scaled direction, per unit of the ray's `t`.
    scaled_t_per_t: f64,
}

impl SlabRay {
    /// A ray with no axis prepared.
    pub(crate) fn new(scaled_t_per_t: f64) -> SlabRay {
        SlabRay {
            near_corner: [0; 3],
            near_origin: [0.0; 3],
            far_origin: [0.0; 3],
            near_inverse: [0.0; 3],
            far_inverse: [0.0; 3],
            // If this is out of range, nothing is culled.
            scaled_t_per_t: if scaled_t_per_t.is_normal() {
                scaled_t_per_t
            } else {
                f64::INFINITY
            },
        }
    }

    /// Prepares axis `k` for a ray from `origin` in anchor space, along a component that has yet to
    /// be scaled.
    pub(crate) fn prepare_axis(
        &mut self,
        k: usize,
        origin: f64,
        direction: f64,
        direction_scale: f64,
    ) {
        // By the component itself: scaled down, it may underflow to 0.
        let negative = direction < 0.0;
        let sign = if negative { -1.0 } else { 1.0 };
        self.near_corner[k] = usize::from(negative);
        let scaled = (direction * direction_scale).abs();
        let (low, high) = (at_or_below(origin), -at_or_below(-origin));
        (self.near_origin[k], self.far_origin[k]) =
            if negative { (low, high) } else { (high, low) };
        let inverse = (1.0 / scaled) as f32;
        // Never infinite, or a ray that starts one rounding before a face would reach it too late.
        self.near_inverse[k] = sign * (inverse * SHRINK).min(f32::MAX);
        // Infinite if the direction is 0: then the ray never leaves.
        self.far_inverse[k] = sign * inverse * GROW;
    }

    /// The scaled `t` at which the ray enters the slab between two faces, never too late, and
    /// leaves it, never too early.
    #[inline]
    pub(crate) fn slab(&self, corners: &Corners, k: usize) -> (f32, f32) {
        // The masks spare bounds checks.
        let (near_face, far_face) = (
            corners[self.near_corner[k] & 1][k],
            corners[!self.near_corner[k] & 1][k],
        );
        (
            (near_face - self.near_origin[k]) * self.near_inverse[k],
            (far_face - self.far_origin[k]) * self.far_inverse[k],
        )
    }

    /// The scaled `t` at which the ray enters the box, never too late; `None` if it misses the box
    /// (slabs of Kay and Kajiya, 1986; rounding as in Ize, "Robust BVH Ray Traversal", 2013).
    ///
    /// The faces are chosen by their addresses. Choosing with minima and maxima, in four lanes or
    /// for two boxes at once, took 1.1 and 1.9 times as long.
    #[inline]
    pub(crate) fn enter(&self, corners: &Corners) -> Option<f32> {
        let mut near = 0.0f32;
        let mut far = f32::INFINITY;
        for k in 0..3 {
            let (entry, exit) = self.slab(corners, k);
            near = larger(entry, near);
            far = smaller(exit, far);
        }
        // Both are equal if they underflow or overflow. The sum loses no hit and helps the
        // compiler: with a plain comparison, tracing the dragon from nearby took 1.23 times as
        // long.
        (near <= far + f32::MIN_POSITIVE).then_some(near)
    }

    /// The ray's `t` per scaled one; 0 if nothing is culled.
    #[inline]
    pub(crate) fn t_per_scaled_t(&self) -> f64 {
        1.0 / self.scaled_t_per_t
    }

    /// `t` in scaled units, rounded like entries: boxes of points up to `t` are not entered later.
    #[inline]
    pub(crate) fn scaled_limit(&self, t: f64) -> f32 {
        (t * self.scaled_t_per_t) as f32
    }
}
