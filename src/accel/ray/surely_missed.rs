//! Triangles that a ray surely misses, sixteen at once.
//!
//! Let p be a point on the ray near the triangles, D the direction times a power of two, r the
//! first corner relative to p, and e and f the edges from it. A hit at p + T D has
//!
//! T D = r + u e + v f, so with c = D x r and g = (D x e) . f
//! u g = -(c . f), v g = c . e, and (1 - u - v) g = g + c . f - c . e.
//!
//! These three numbers are the edge functions. The ray misses the triangle if one is above 0 and
//! another below, whatever the sign of g (see [`crate::shape::Triangle::exact`]).
//!
//! # Bounds
//!
//! Let U = 2^-24, and let M, R and E be the largest components of D, of r, and of e and f. Numbers
//! are rounded to `f32` once before anything is computed; r takes one rounding in `f64` before, and
//! the computed p is up to d away from the ray on each axis.
//!
//! *c.* A component has two products of up to M R. Their factors are rounded, then each product,
//! then the difference: up to 4 U of 2 M R. The error of p adds 2 M d.
//!
//! *c . e and c . f* have three products. The error of c contributes 24 U E M R + 6 E M d, that of
//! the edge and the product 12 U E M R, and the two sums at most another 12 U E M R.
//!
//! *g* has the same form with e in the place of r and no error of p: 48 U E E M.
//!
//! *The third function* adds the errors of all three, and two roundings of up to 12 U E M (R + E).
//! So the error of each function is below
//!
//! 128 U E M (R + E) + 16 E M d,
//!
//! which leaves room for terms in U^2, for the roundings of the bound, and for M, R and E, which
//! are the largest of rounded numbers. Fused products have fewer roundings. Underflow loses up to
//! 2^-150 with each rounding, multiplied by what follows: a tiny number is added to R, to E, and to
//! the bound. Overflow is out of the question where R + E is below 2^48, since M is up to 2^24 at
//! most; farther triangles are never left out. Comparisons with NaN fail, which leaves out nothing
//! either.

use super::narrow_ray::{NarrowRay, PointOnRay};
use crate::accel::tree::TriangleLanes;
use crate::simd::{F32s, F64s, Lanes, Mask};

/// U of the module head.
const U: f32 = f32::EPSILON / 2.0;
/// Covers the underflow of factors and of results.
const TINY: f32 = 1.0 / (1u128 << 120) as f32;
/// Bounds R + E.
const FAR: f32 = (1u64 << 48) as f32;

/// The lanes whose triangles the ray surely misses, lane k as bit k. `start` is a point on the ray;
/// the nearer to the triangles, the fewer remain.
#[inline(always)]
pub(super) fn surely_missed<S: Lanes>(
    simd: S,
    ray: &NarrowRay,
    start: &PointOnRay,
    triangles: &TriangleLanes<S>,
) -> u32 {
    let TriangleLanes { first, edges } = triangles;
    let [e, f] = edges;
    let mut r = *e;
    for k in 0..3 {
        r[k] = (first[k] - simd.splat_wide(start.point[k])).narrow();
    }
    let across_r = across(simd, ray, &r);
    let (c_e, c_f) = (dot::<S>(&across_r, e), dot::<S>(&across_r, f));
    let g = dot::<S>(&across(simd, ray, e), f);
    let (zero, tiny) = (simd.splat(0.0), simd.splat(TINY));
    let first_function = zero - c_f;
    let third_function = g + (c_f - c_e);

    let extent = largest::<S>(e).max(largest::<S>(f)) + tiny;
    let size = simd.splat(ray.size);
    let reach = largest::<S>(&r) + extent;
    let error =
        (reach * simd.splat(128.0 * U) + simd.splat(16.0 * start.error)) * (extent * size) + tiny;
    let greatest = first_function.max(c_e).max(third_function);
    let least = first_function.min(c_e).min(third_function);
    let is_outside = greatest.above(error) & (zero - error).above(least);
    (is_outside & simd.splat(FAR).above(reach)).bits()
}

/// D x v.
#[inline(always)]
fn across<S: Lanes>(simd: S, ray: &NarrowRay, v: &[S::F; 3]) -> [S::F; 3] {
    let mut product = *v;
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let negative = v[i] * simd.splat(-ray.direction[j]);
        product[k] = v[j].fused_or_not(simd.splat(ray.direction[i]), negative);
    }
    product
}

#[inline(always)]
fn dot<S: Lanes>(a: &[S::F; 3], b: &[S::F; 3]) -> S::F {
    let sum = a[1].fused_or_not(b[1], a[0] * b[0]);
    a[2].fused_or_not(b[2], sum)
}

/// The largest magnitude of a component.
#[inline(always)]
fn largest<S: Lanes>(v: &[S::F; 3]) -> S::F {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::tree::PrimitiveBlock;
    use crate::geometry::{Point, Ray, Vector};
    use crate::shape::{Primitive, PrimitiveId, Triangle};
    use crate::simd::{LANES, Level, SimdKernel};
    use proptest::prelude::*;

    struct Missed<'a> {
        block: &'a PrimitiveBlock,
        ray: &'a NarrowRay,
        t: f64,
    }

    impl SimdKernel for Missed<'_> {
        type Output = u32;

        #[inline(always)]
        fn run<S: Lanes>(self, simd: S) -> u32 {
            let triangles = self.block.triangle_lanes(simd);
            surely_missed(simd, self.ray, &self.ray.point_at(self.t), &triangles)
        }
    }

    /// Asserts that no level leaves out a triangle that the ray hits. Returns the number of those
    /// that it leaves out.
    fn checked(ray: &Ray, triangles: &[Triangle], t: f64) -> u32 {
        let mut block = PrimitiveBlock::empty();
        for (lane, triangle) in triangles.iter().enumerate() {
            block.push(PrimitiveId::triangle(lane), &Primitive::Triangle(*triangle));
        }
        let missed = Level::ALL.map(|level| {
            let missed = level.run(Missed {
                block: &block,
                ray: &NarrowRay::new(ray),
                t,
            });
            for (lane, triangle) in triangles.iter().enumerate() {
                let is_missed = missed >> lane & 1 != 0;
                assert!(
                    !is_missed || triangle.exact(ray).is_none(),
                    "{level}, from t = {t}: {ray:?} {triangle:?}"
                );
            }
            missed & block.triangles
        });
        missed[0].count_ones()
    }

    /// Whole numbers, with which many rays meet edges and corners, and others of many sizes.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            3 => (-3i32..4).prop_map(f64::from),
            3 => -3.0f64..3.0,
            1 => (-1.0f64..1.0, -70i32..70).prop_map(|(x, exponent)| x * 2f64.powi(exponent)),
        ]
    }

    fn point() -> impl Strategy<Value = Point> {
        prop::array::uniform3(coordinate()).prop_map(Point::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        /// Rays aim at corners, at edges and very close to them.
        #[test]
        fn no_hit_is_left_out(
            corners in prop::collection::vec(prop::array::uniform3(point()), 1..=LANES),
            origin in point(),
            along in prop::sample::select(vec![0.0, 0.25, 0.5, 1.0, 0.7]),
            aside in -1.0f64..1.0,
            closeness in prop::sample::select(vec![0.0, 1.0, 1e-3, 1e-6, 1e-7, 1e-8, 1e-15]),
            length in prop::sample::select(vec![1.0, 3.7, 1e-30, 1e30, 1e-306, 1e300]),
            start in prop::sample::select(vec![0.0, 0.5, 0.99, 1.0, 1.5, 1e9]),
            size in prop::sample::select(vec![0, 0, 0, -120, -40, 30, 60, 100]),
            offset in prop::sample::select(vec![0.0, 0.0, 1e3, 1e6]),
        ) {
            let sized = |p: &Point| {
                Point::from(p.to_array().map(|x| (x + offset) * 2f64.powi(size)))
            };
            let triangles: Vec<Triangle> =
                corners.iter().map(|corners| Triangle(corners.each_ref().map(sized))).collect();
            let [a, b, c] = triangles[0].0;
            let target = |k: usize| {
                a[k] + along * (b[k] - a[k]) + aside * closeness * (c[k] - a[k])
            };
            let origin = sized(&origin);
            let to_target = Point::new(target(0), target(1), target(2)) - origin;
            let ray = Ray { origin, direction: to_target * length };
            prop_assume!(ray.can_hit());
            checked(&ray, &triangles, start / length);
        }

        /// Far from the origin of the world and from the eye, too.
        #[test]
        fn triangles_beside_the_ray_are_left_out(
            x in -9i32..10,
            y in -9i32..10,
            offset in prop::sample::select(vec![0.0, 1e4]),
        ) {
            let corner = |x: i32, y: i32| {
                Point::new(offset + f64::from(x) * 0.01, f64::from(y) * 0.01, 100.0 + offset)
            };
            let triangles: Vec<Triangle> = (0..16)
                .map(|k| (k % 4 - 2, k / 4 - 2))
                .map(|(x, y)| Triangle([corner(x, y), corner(x + 1, y), corner(x, y + 1)]))
                .collect();
            let target = corner(x, y);
            let origin = Point::new(offset - 3.0, 1.0, offset);
            let direction =
                Vector::new(target.x + 0.004 - origin.x, target.y + 0.003 - origin.y, 100.0);
            let ray = Ray { origin, direction };
            let is_inside = (-2..2).contains(&x) && (-2..2).contains(&y);
            prop_assert_eq!(checked(&ray, &triangles, 0.99), 16 - u32::from(is_inside));
        }
    }
}
