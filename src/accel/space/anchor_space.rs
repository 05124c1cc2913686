//! Anchor space: boxes and rays in `f32` relative to an anchor, rounded so that no hit is lost.
//!
//! Anchor space is world space moved so that the anchor (the eye of the view) is the origin, and
//! scaled by a power of two so that nothing overflows.
//!
//! # Why no box loses a hit
//!
//! Let a ray hit a primitive at p = o + T d, T > 0, exactly. In exact anchor space, along one axis,
//! with D the direction times its own power of two and T in the units that follow, T = (P - O) / D
//! if D is not 0; the primitive's bounds are L <= P <= H. Let u = 2^-24.
//!
//! *Boxes* are stored as l < L and h > H, strictly. The difference to the anchor is rounded to the
//! nearest `f64`, and l is the next `f32` below that result: at least one unit in the last place of
//! the `f64` below it, while the error of the result is half of one. Underflow of the scaling is
//! far smaller than the least `f32`. The same rounding is monotone, which settles points in the
//! plane of a face: of two coordinates the larger one stays larger or becomes equal, and only then
//! the strict step is taken.
//!
//! *Origins* are bracketed by ol <= o' <= oh in `f32`, where o' is the computed difference. For an
//! eye that is the anchor it is 0, otherwise its error is up to 2^-53 |O|.
//!
//! *Entry.* If l - oh is not positive, its product is not positive either, and T is. Otherwise l
//! and oh are different `f32`, so that l - oh >= u |oh|, of which the error of O is a 2^-29th. The
//! reciprocal of D, its narrowing to `f32`, its product with `SHRINK` and the difference each round
//! by up to u: before it is rounded itself, the product is no more than
//! (L - O) / D (1 + u)^5 (1 - 8u) < T. A reciprocal too large for `f32` becomes its largest number,
//! which is smaller.
//!
//! *Exit.* h > H >= P and the monotone rounding of both give h > ol, strictly: the product is
//! positive even if the reciprocal is infinite, and `0 * infinity` cannot occur. By the same count
//! it exceeds T before it is rounded.
//!
//! *D = 0.* Then P = O, so l < oh and h > ol: the entry is negative and the exit infinite. *A
//! component that underflows* when D is scaled keeps its sign, and the reciprocals are those of 0,
//! one too small and the other too large. *NaN* only arises from infinite bounds, or from two
//! numbers that rounding made equal times an infinite reciprocal: a comparison with it fails, which
//! keeps the previous value.
//!
//! So on every axis entry < T < exit before the last rounding, which is monotone even if it
//! underflows or overflows: the latest entry is not above the earliest exit, and the ray enters the
//! box. For the same reason the entry is not above the upper end of the best hit's bracket, rounded
//! as well, if T is not: whatever is as near as the best is visited, because it may win the tie.
//!
//! *Trees.* A node's box is the union of those below it. Every step is monotone: a larger box gives
//! an earlier entry and a later exit, in floating point too. So a ray that enters a primitive's box
//! enters every node around it, no later.

use super::box32::{Box32, Corners};
use super::rounding::{above, below};
use super::slab_ray::SlabRay;
use crate::exact::{exponent_of, power_of_two};
use crate::geometry::{Bounds, Point, Ray};
use crate::per_axis::per_axis;

/// The space in which boxes and rays are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AnchorSpace {
    anchor: Point,
    /// The power of two that coordinates are multiplied by before the anchor's are subtracted; 1
    /// unless the difference would overflow.
    before: f64,
    /// The power of two that the differences are multiplied by.
    scale: f64,
}

/// Coordinates are scaled to below 2^32, so that areas of boxes and sums of two coordinates stay
/// far from the ends of the `f32` range.
const LARGEST_EXPONENT: i32 = 31;

impl AnchorSpace {
    /// A space for points whose coordinates differ from those of `anchor` by up to `reach`, which
    /// is infinite if a difference overflows.
    pub(crate) fn new(anchor: Point, reach: f64) -> AnchorSpace {
        let before = if reach == f64::INFINITY { 0.25 } else { 1.0 };
        let exponent = match reach {
            f64::INFINITY => 1023,
            0.0 => 0,
            reach => exponent_of(reach),
        };
        // Within the exponents of normal numbers; the outward rounding covers the rest.
        AnchorSpace {
            anchor,
            before,
            scale: power_of_two((LARGEST_EXPONENT - exponent).clamp(-1000, 1000)),
        }
    }

    /// A coordinate of a point, before it is rounded to `f32`.
    #[inline]
    fn coordinate(&self, point: &Point, axis: usize) -> f64 {
        self.along(point[axis], axis)
    }

    /// The coordinate `x` on `axis` in world space, before it is rounded to `f32`.
    #[inline(always)]
    fn along(&self, x: f64, axis: usize) -> f64 {
        (x * self.before - self.anchor[axis] * self.before) * self.scale
    }

    /// A box strictly around `bounds` in world space.
    pub(crate) fn enclose(&self, bounds: &Bounds) -> Box32 {
        let low = |k| self.low_face(bounds.low[k], k);
        let high = |k| self.high_face(bounds.high[k], k);
        Box32 {
            low: [low(0), low(1), low(2)],
            high: [high(0), high(1), high(2)],
        }
    }

    /// The box in world space; each coordinate is rounded once.
    pub(crate) fn reveal(&self, corners: &Corners) -> Bounds {
        let coordinate = |x: f32, axis: usize| {
            (f64::from(x) / self.scale + self.anchor[axis] * self.before) / self.before
        };
        let point = |corner: &[f32; 4]| per_axis(|axis| coordinate(corner[axis], axis)).into();
        Bounds {
            low: point(&corners[0]),
            high: point(&corners[1]),
        }
    }

    /// The low face across `axis` of a box that begins at `x` in world space.
    #[inline(always)]
    pub(crate) fn low_face(&self, x: f64, axis: usize) -> f32 {
        below(self.along(x, axis))
    }

    /// The high face across `axis` of a box that ends at `x` in world space.
    #[inline(always)]
    pub(crate) fn high_face(&self, x: f64, axis: usize) -> f32 {
        above(self.along(x, axis))
    }

    /// Prepares a ray for the slab test.
    pub(crate) fn ray(&self, ray: &Ray) -> SlabRay {
        let direction_scale = direction_scale(ray);
        let mut slab = SlabRay::new(self.units() / direction_scale);
        for k in 0..3 {
            slab.prepare_axis(
                k,
                self.coordinate(&ray.origin, k),
                ray.direction[k],
                direction_scale,
            );
        }
        slab
    }

    /// The ray in `f32`, each number rounded to the nearest.
    pub(crate) fn single_ray(&self, ray: &Ray) -> SingleRay {
        let direction_scale = direction_scale(ray);
        let direction = ray.direction.to_array();
        SingleRay {
            origin: self.place(&ray.origin),
            direction: direction.map(|component| (component * direction_scale) as f32),
            largest_axis: ray.direction.largest_axis(),
            direction_scale,
            space: *self,
        }
    }

    /// A point in anchor space, each coordinate rounded to the nearest `f32`.
    #[inline]
    pub(crate) fn place(&self, point: &Point) -> [f32; 3] {
        [
            self.coordinate(point, 0) as f32,
            self.coordinate(point, 1) as f32,
            self.coordinate(point, 2) as f32,
        ]
    }

    /// The origin of anchor space.
    pub(crate) fn anchor(&self) -> Point {
        self.anchor
    }

    /// Bounds the difference of any coordinate of a primitive from the anchor's.
    pub(crate) fn reach(&self) -> f64 {
        power_of_two(LARGEST_EXPONENT + 1) / self.units()
    }

    /// Units of anchor space per unit of world space.
    pub(crate) fn units(&self) -> f64 {
        self.scale * self.before
    }
}

/// The power of two that scales the largest component of the direction to about 1.
fn direction_scale(ray: &Ray) -> f64 {
    power_of_two(-exponent_of(ray.direction.largest()).clamp(-1000, 1000))
}

/// A ray in anchor space, in `f32`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SingleRay {
    pub(crate) origin: [f32; 3],
    /// The direction, scaled by a power of two.
    pub(crate) direction: [f32; 3],
    pub(crate) largest_axis: usize,
    direction_scale: f64,
    space: AnchorSpace,
}

impl SingleRay {
    /// Converts `t` from anchor space to world space.
    pub(crate) fn unscaled(&self, scaled: f32) -> f64 {
        f64::from(scaled) * self.direction_scale / self.space.before / self.space.scale
    }

    /// Converts `t` from world space to anchor space, rounded.
    pub(crate) fn scaled(&self, t: f64) -> f32 {
        (t * self.space.scale * self.space.before / self.direction_scale) as f32
    }
}

#[cfg(test)]
mod tests;
