//! Boxes and rays in `f32`, relative to an anchor, rounded so that no hit is lost.
//!
//! Anchor space is world space moved so that the anchor (the eye of the view) is the origin, and scaled by a power
//! of two so that nothing overflows.
//!
//! # Why no box loses a hit
//!
//! Let a ray hit a primitive at p = o + T d, T > 0, exactly. In exact anchor space, along one axis, with D the direction
//! times its own power of two and T in the units that follow, T = (P - O) / D where D is not 0; the primitive's bounds
//! are L <= P <= H. Let u = 2^-24.
//!
//! *Boxes* are stored as l < L and h > H, strictly. The difference to the anchor is rounded to the nearest `f64`, and l is the
//! next `f32` below that result, so at least one unit in the last place of the `f64` below it, where the result is off by
//! half of one. What underflows in the scaling is by far smaller than the least `f32`. The same rounding is monotone,
//! and that settles what lies in the plane of a face: of two coordinates the larger one stays the larger or becomes
//! equal, and only then the strict step is taken.
//!
//! *Origins* are bracketed by ol <= o' <= oh in `f32`, where o' is the computed difference, which for an eye that is the
//! anchor is 0, and otherwise is off by 2^-53 |O| at most.
//!
//! *Entry.* Where l - oh is not above 0, its product is not above 0 either, and T is. Else l and oh are different `f32`, so
//! that l - oh >= u |oh|, of which the error of O is a 2^-29th. The reciprocal of D, its narrowing to `f32`, its product with
//! `SHRINK`, the difference and the product with it each round by u at most: computed is at most
//! (L - O) / D (1 + u)^5 (1 - 8u) < T (1 - 2u), or 2^-150 more, where the product underflows. A reciprocal too large for
//! `f32` becomes its largest number, which is smaller.
//!
//! *Exit.* h > H >= P and the monotone rounding of both give h > ol, strictly: the product is above 0 even where the
//! reciprocal is infinite, and `0 * infinity` cannot occur. By the same count it is at least T (1 + 2u), or 2^-150 less.
//!
//! *D = 0*: then P = O, so l < oh and h > ol: the entry is below 0 and the exit infinite. *A component that underflows* when D
//! is scaled would be neither; such an axis is left out. *NaN* only comes from infinite bounds: the comparison with it fails
//! in favour of what was known before.
//!
//! So the latest entry is at most T (1 - 2u) + 2^-150 and the earliest exit at least T (1 + 2u) - 2^-150: the box is entered, and
//! no later than T. The entry is compared with the upper end of the best hit's bracket, rounded up, so that what lies as near
//! as the best is visited: it may win the tie.
//!
//! *Trees.* A node's box is the union of those below it. Every step is monotone: a larger box gives an earlier entry and
//! a later exit, in floating point too. So whatever enters a primitive's box enters every node around it, no later.

use crate::exact::{exponent_of, power_of_two};
use crate::geometry::{Bounds, Point, Ray};

/// Where boxes and rays are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AnchorSpace {
    anchor: Point,
    /// Coordinates are multiplied by this power of two before the anchor's are subtracted; 1 unless that would overflow.
    before: f64,
    /// A power of two, for the differences.
    scale: f64,
}

/// A box in anchor space, a little larger than what it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Box32 {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

/// The low and the high corner of a box, with a lane to spare in each.
pub(super) type Corners = [[f32; 4]; 2];

/// Coordinates are scaled to below 2^32, so that areas of boxes and sums of two coordinates stay far from the ends
/// of the `f32` range.
const LARGEST_EXPONENT: i32 = 31;

impl AnchorSpace {
    /// For points around `anchor` whose coordinates differ from it by up to `reach`, which is infinite where a difference
    /// overflows.
    pub(super) fn new(anchor: Point, reach: f64) -> AnchorSpace {
        let before = if reach == f64::INFINITY { 0.25 } else { 1.0 };
        let exponent = match reach {
            f64::INFINITY => 1023,
            0.0 => 0,
            reach => exponent_of(reach),
        };
        // Within the exponents of normal numbers; at the ends the outward rounding does what is left.
        AnchorSpace { anchor, before, scale: power_of_two((LARGEST_EXPONENT - exponent).clamp(-1000, 1000)) }
    }

    /// A coordinate of a point, before it is narrowed to `f32`.
    #[inline]
    fn coordinate(&self, point: &Point, axis: usize) -> f64 {
        (point[axis] * self.before - self.anchor[axis] * self.before) * self.scale
    }

    /// The box around world-space `bounds`, strictly.
    pub(super) fn enclose(&self, bounds: &Bounds) -> Box32 {
        let low = |k| below(self.coordinate(&bounds.low, k));
        let high = |k| above(self.coordinate(&bounds.high, k));
        Box32 { low: std::array::from_fn(low), high: std::array::from_fn(high) }
    }

    /// The ray as the slab test needs it.
    pub(super) fn ray(&self, ray: &Ray) -> SlabRay {
        let direction_scale = direction_scale(ray);
        let ratio = self.scale * self.before / direction_scale;
        let mut slab = SlabRay {
            near_corner: [0; 3],
            near_origin: [0.0; 3],
            far_origin: [0.0; 3],
            near_inverse: [0.0; 3],
            far_inverse: [0.0; 3],
            // Beyond the range of f64 nothing is culled.
            scaled_t_per_t: if ratio.is_normal() { ratio } else { f64::INFINITY },
        };
        for k in 0..3 {
            slab.prepare_axis(k, self.coordinate(&ray.origin, k), ray.direction[k], direction_scale);
        }
        slab
    }

    /// The ray as the test in `f32` needs it, each number rounded to the nearest.
    pub(super) fn single_ray(&self, ray: &Ray) -> SingleRay {
        let direction_scale = direction_scale(ray);
        SingleRay {
            origin: self.place(&ray.origin),
            direction: ray.direction.to_array().map(|component| (component * direction_scale) as f32),
            largest_axis: ray.direction.largest_axis(),
            direction_scale,
            space: *self,
        }
    }

    /// A point in anchor space, each coordinate rounded to the nearest `f32`.
    #[inline]
    pub(super) fn place(&self, point: &Point) -> [f32; 3] {
        std::array::from_fn(|k| self.coordinate(point, k) as f32)
    }

    /// Units of anchor space in one of world space.
    pub(super) fn units(&self) -> f64 {
        self.scale * self.before
    }
}

/// A power of two by which the largest component of the direction becomes about 1.
fn direction_scale(ray: &Ray) -> f64 {
    power_of_two(-exponent_of(ray.direction.largest()).clamp(-1000, 1000))
}

/// A ray in anchor space, in `f32`.
#[derive(Debug, Clone, Copy)]
pub(super) struct SingleRay {
    pub(super) origin: [f32; 3],
    /// Times a power of two.
    pub(super) direction: [f32; 3],
    pub(super) largest_axis: usize,
    direction_scale: f64,
    space: AnchorSpace,
}

impl SingleRay {
    /// The `t` of the ray in world space for one in anchor space.
    pub(super) fn unscaled(&self, scaled: f32) -> f64 {
        f64::from(scaled) * self.direction_scale / self.space.before / self.space.scale
    }
}

/// Five roundings to nearest lie between the exact quotient and the computed one, 2^-24 each: see the head of this file.
const SHRINK: f32 = 1.0 - 8.0 * (f32::EPSILON / 2.0);
const GROW: f32 = 1.0 + 8.0 * (f32::EPSILON / 2.0);

/// A ray in anchor space, prepared for [`SlabRay::enter`].
///
/// The face where the ray enters a slab is measured from the end of the origin's bracket that is nearer to it, and
/// divided by a direction too large; the other face from the other end, by a direction too small.
#[derive(Debug, Clone, Copy)]
pub(super) struct SlabRay {
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
    /// Prepares axis `k` for a ray from `origin`, in anchor space.
    fn prepare_axis(&mut self, k: usize, origin: f64, direction: f64, direction_scale: f64) {
        let negative = direction < 0.0;
        let sign = if negative { -1.0 } else { 1.0 };
        self.near_corner[k] = usize::from(negative);
        let scaled = (direction * direction_scale).abs();
        if scaled < f64::MIN_POSITIVE && direction != 0.0 {
            // Underflow: nobody knows when the ray leaves this slab, so it is taken for endless.
            (self.near_origin[k], self.far_origin[k]) = (sign * f32::INFINITY, sign * f32::NEG_INFINITY);
            (self.near_inverse[k], self.far_inverse[k]) = (sign, sign);
            return;
        }
        let (low, high) = (at_or_below(origin), -at_or_below(-origin));
        (self.near_origin[k], self.far_origin[k]) = if negative { (low, high) } else { (high, low) };
        let inverse = (1.0 / scaled) as f32;
        // Never infinite, or a ray that starts a rounding before a face would reach it too late.
        self.near_inverse[k] = sign * (inverse * SHRINK).min(f32::MAX);
        // Infinite where the direction is 0: then the ray never leaves.
        self.far_inverse[k] = sign * inverse * GROW;
    }

    /// The scaled `t` at which the ray enters the box, never too late, or `None` where it misses the box (Kay and
    /// Kajiya's slabs, 1986; rounding as Ize, "Robust BVH Ray Traversal", 2013).
    ///
    /// The faces are chosen by their addresses. Choosing with minima and maxima, in four lanes or for two boxes at
    /// once, took 1.1 and 1.9 times as long.
    #[inline]
    pub(super) fn enter(&self, corners: &Corners) -> Option<f32> {
        let mut near = 0.0f32;
        let mut far = f32::INFINITY;
        for k in 0..3 {
            // The masks spare the checks that the indices are in range.
            let (near_face, far_face) = (corners[self.near_corner[k] & 1][k], corners[!self.near_corner[k] & 1][k]);
            near = larger((near_face - self.near_origin[k]) * self.near_inverse[k], near);
            far = smaller((far_face - self.far_origin[k]) * self.far_inverse[k], far);
        }
        // A product may underflow by less than the least normal number; a hit lies strictly within the box.
        (near <= far + f32::MIN_POSITIVE).then_some(near)
    }

    /// `t` in scaled units, never too small: nothing at `t` or before it may be culled.
    #[inline]
    pub(super) fn scaled_limit(&self, t: f64) -> f32 {
        -at_or_below(-(t * self.scaled_t_per_t))
    }
}

/// The larger of the two; the second where the first is NaN.
#[inline]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller of the two; the second where the first is NaN.
#[inline]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The largest `f32` up to `x`; infinite only where `x` is.
fn at_or_below(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x { nearest.next_down() } else { nearest }
}

/// An `f32` less than `x`, and not 0: a face in the plane of the origin is on its own side of it.
fn below(x: f64) -> f32 {
    let lower = at_or_below(x);
    let lower = if f64::from(lower) < x { lower } else { lower.next_down() };
    if lower == 0.0 { -f32::from_bits(1) } else { lower }
}

/// An `f32` greater than `x`, and not 0.
fn above(x: f64) -> f32 {
    -below(-x)
}

impl Box32 {
    /// The corners in four lanes, the last one free.
    pub(super) fn corners(&self) -> Corners {
        let ([x0, y0, z0], [x1, y1, z1]) = (self.low, self.high);
        [[x0, y0, z0, 0.0], [x1, y1, z1, 0.0]]
    }

    /// The box of nothing.
    pub(super) const EMPTY: Box32 = Box32 { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// The smallest box around both.
    #[inline]
    pub(super) fn union(&self, other: &Box32) -> Box32 {
        Box32 {
            low: std::array::from_fn(|k| smaller(self.low[k], other.low[k])),
            high: std::array::from_fn(|k| larger(self.high[k], other.high[k])),
        }
    }

    /// Half the surface area.
    #[inline]
    pub(super) fn half_area(&self) -> f32 {
        let [x, y, z] = self.extent();
        x * y + y * z + z * x
    }

    /// The lengths of the sides.
    #[inline]
    pub(super) fn extent(&self) -> [f32; 3] {
        std::array::from_fn(|k| self.high[k] - self.low[k])
    }

    /// Whether `other` lies within.
    pub(super) fn contains(&self, other: &Box32) -> bool {
        (0..3).all(|k| self.low[k] <= other.low[k] && other.high[k] <= self.high[k])
    }

    /// Twice the centre.
    #[inline]
    pub(super) fn doubled_centre(&self) -> [f32; 3] {
        std::array::from_fn(|k| self.low[k] + self.high[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Dyadic;
    use crate::geometry::Vector;
    use proptest::prelude::*;
    use std::cmp::Ordering::{Equal, Greater, Less};

    /// Small whole numbers, numbers with all their bits, and tiny ones.
    fn component() -> impl Strategy<Value = f64> {
        let odd = prop_oneof![3 => Just(0), 2 => -80i32..0, 1 => -600i32..0];
        prop_oneof![
            (-3i32..4).prop_map(f64::from),
            (-1.0f64..1.0),
            (-1.0f64..1.0, odd).prop_map(|(x, exponent)| x * 2f64.powi(exponent)),
        ]
    }

    fn enter(slab: &SlabRay, bounds: &Box32) -> Option<f32> {
        slab.enter(&bounds.corners())
    }

    #[test]
    fn rounding_is_strict_and_avoids_zero() {
        assert_eq!(below(1.0), 1.0f32.next_down());
        assert_eq!(below(0.0), -f32::from_bits(1));
        assert_eq!(below(1e-300), -f32::from_bits(1));
        assert_eq!(above(-1e-300), f32::from_bits(1));
        assert_eq!(below(f64::MAX), f32::MAX);
        assert_eq!(above(f64::MAX), f32::INFINITY);
    }

    #[test]
    fn a_ray_in_the_plane_of_a_flat_box_enters_it() {
        let space = AnchorSpace::new(Point::default(), 9.0);
        let flat = Bounds { low: Point::new(0.0, -1.0, 2.0), high: Point::new(0.0, 1.0, 9.0) };
        let ray = Ray { origin: Point::default(), direction: Vector::new(0.0, 0.0, 1.0) };
        let slab = space.ray(&ray);
        let near = enter(&slab, &space.enclose(&flat)).expect("it lies in the box");
        let near_t = space.single_ray(&ray).unscaled(near);
        assert!(near_t < 2.0 && near_t > 1.999);
        assert!(near > slab.scaled_limit(1.0) && near <= slab.scaled_limit(2.0));
    }

    proptest! {
        /// The point at which a ray meets a box's content is never lost, for any sizes and any place of the anchor.
        #[test]
        fn no_point_of_the_content_is_lost(
            origin in prop::array::uniform3(-4i32..5),
            target in prop::array::uniform3(-4i32..5),
            anchor in prop::array::uniform3(-4i32..5),
            size in prop::sample::select(vec![1e-300, 1e-30, 0.1, 1.0, 1e30, 1e300]),
            speed in prop::sample::select(vec![1e-200, 0.3, 1.0, 1e200]),
        ) {
            let point = |p: [i32; 3]| Point::from(p.map(|x| f64::from(x) * size));
            let (origin, target, anchor) = (point(origin), point(target), point(anchor));
            prop_assume!(origin != target);
            let space = AnchorSpace::new(anchor, 8.0 * size);
            let toward = target - origin;
            let direction = Vector::from(toward.to_array().map(|x| x / size * speed));
            let ray = Ray { origin, direction };
            let slab = space.ray(&ray);
            let content = space.enclose(&Bounds { low: target, high: target });
            let t = size / speed;
            prop_assume!(t.is_normal());
            let near = enter(&slab, &content);
            prop_assert!(near.is_some());
            prop_assert!(space.single_ray(&ray).unscaled(near.unwrap()) <= t);
            prop_assert!(near.unwrap() <= slab.scaled_limit(t));
        }

        /// Exactly: whatever point a ray passes, at whatever `t`, the smallest box of f64 around it is entered by then.
        #[test]
        fn no_hit_is_lost(
            direction in prop::array::uniform3(component()),
            origin in prop::array::uniform3(component()),
            offset in prop::array::uniform3(component()),
            t in 1u32..1 << 31,
            exponents in prop::array::uniform3(-300i32..300),
            perspective in any::<bool>(),
            room in 0i32..40,
        ) {
            let times = |v: [f64; 3], exponent: i32| v.map(|x| x * 2f64.powi(exponent));
            let direction = Vector::from(times(direction, exponents[0]));
            let origin = Point::from(times(origin, exponents[1]));
            let t = f64::from(t) * 2f64.powi(exponents[2] - 31);
            let offset = Vector::from(times(offset, if perspective { -2000 } else { exponents[1] }));
            let ray = Ray { origin, direction };
            prop_assume!(ray.can_hit());
            let along = |k: usize| &Dyadic::from(origin[k]) + &(&Dyadic::from(t) * &Dyadic::from(direction[k]));
            let ends: [[f64; 2]; 3] = std::array::from_fn(|k| {
                let nearest = along(k).to_f64();
                match Dyadic::from(nearest).cmp(&along(k)) {
                    Less => [nearest, nearest.next_up()],
                    Equal => [nearest, nearest],
                    Greater => [nearest.next_down(), nearest],
                }
            });
            let bounds = Bounds { low: ends.map(|[low, _]| low).into(), high: ends.map(|[_, high]| high).into() };
            let anchor = origin + offset;
            let reach = (bounds.low - anchor).largest().max((bounds.high - anchor).largest());
            let space = AnchorSpace::new(anchor, reach * 2f64.powi(room));
            let slab = space.ray(&ray);
            let near = enter(&slab, &space.enclose(&bounds));
            prop_assert!(near.is_some());
            prop_assert!(near.unwrap() <= slab.scaled_limit(t), "{near:?} is beyond {}", slab.scaled_limit(t));
        }

        #[test]
        fn a_larger_box_is_entered_no_later(
            low in prop::array::uniform3(-9i32..9),
            size in prop::array::uniform3(0i32..4),
            more in prop::array::uniform6(0i32..3),
            origin in prop::array::uniform3(-9i32..9),
            direction in prop::array::uniform3(-3i32..4),
        ) {
            prop_assume!(direction != [0; 3]);
            let space = AnchorSpace::new(Point::default(), 16.0);
            let corner = |f: &dyn Fn(usize) -> i32| Point::from(std::array::from_fn::<f64, 3, _>(|k| f64::from(f(k))));
            let inner = Bounds { low: corner(&|k| low[k]), high: corner(&|k| low[k] + size[k]) };
            let outer = Bounds {
                low: corner(&|k| low[k] - more[k]),
                high: corner(&|k| low[k] + size[k] + more[k + 3]),
            };
            let ray = Ray { origin: corner(&|k| origin[k]), direction: (corner(&|k| direction[k])) - Point::default() };
            let slab = space.ray(&ray);
            if let Some(near) = enter(&slab, &space.enclose(&inner)) {
                let outer = enter(&slab, &space.enclose(&outer));
                prop_assert!(outer.is_some_and(|outer| outer <= near));
            }
        }
    }
}
