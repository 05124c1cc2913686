//! Spheres under an affine transform, whole or cut: where they are, and which can be hit at all.

mod cut;
mod exact;
mod filter;
mod single;

pub use cut::{Cut, Sector};
pub(crate) use single::SingleSphere;

use crate::exact::{exponent_of, power_of_two};
use crate::geometry::{Bounds, Matrix, Point, Vector};

/// The points `world_from_object * q` with `|q| = radius` that the cut leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Places and stretches the sphere.
    pub world_from_object: Matrix,
    /// In object space.
    pub radius: f64,
    /// What of it there is; `None` for all of it.
    pub cut: Option<Cut>,
}

impl Sphere {
    /// Whether any ray can hit it (rule E2).
    pub fn can_be_hit(&self) -> bool {
        self.radius > 0.0
            && self.radius.is_finite()
            && self.world_from_object.is_finite()
            && !self.world_from_object.is_singular()
    }

    /// A box around it, a few units of rounding too large at most.
    pub fn bounds(&self) -> Bounds {
        let row = |k: usize| &self.world_from_object.rows[k];
        // Along an axis the ellipsoid reaches |row| * radius. Squares and sums are off by 3 units of 2^-53, their
        // root by half of that and its own, and three products follow: less than 6 of the 8 units that the factor adds.
        // The last sum's rounding is what `next_up` and `next_down` are for.
        let reach = |k: usize| {
            // The row is scaled to a length between 1 and 4, so only the result can leave the range, not the way to it.
            let scale = power_of_two_near_largest(&row(k)[..3]);
            let v = Vector::from([0, 1, 2].map(|j| row(k)[j] / scale));
            v.dot(v).sqrt() * (self.radius * scale) * (1.0 + 4.0 * f64::EPSILON) + LOST_TO_UNDERFLOW
        };
        let low = |k: usize| (row(k)[3] - reach(k)).next_down();
        let high = |k: usize| (row(k)[3] + reach(k)).next_up();
        Bounds { low: Point::new(low(0), low(1), low(2)), high: Point::new(high(0), high(1), high(2)) }
    }

    /// A power of two near the largest entry of the linear part of the matrix.
    fn scale(&self) -> f64 {
        power_of_two_near_largest(self.world_from_object.rows.iter().flat_map(|row| &row[..3]))
    }
}

/// More than three products lose that end below the least normal number, one of them times 3. The step that follows is
/// mostly enough.
const LOST_TO_UNDERFLOW: f64 = f64::from_bits(4);

/// The largest power of two up to the largest absolute value of `numbers`; 1 where that is 0 or not finite, the least normal
/// number where it is subnormal.
fn power_of_two_near_largest<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> f64 {
    let largest = numbers.into_iter().fold(0.0f64, |max, number| max.max(number.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return 1.0;
    }
    power_of_two(exponent_of(largest.max(f64::MIN_POSITIVE)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Dyadic, ExactVector, times_power_of_two};
    use crate::geometry::Ray;
    use crate::shape::{FilterRay, Verdict};
    use proptest::prelude::*;

    fn unit(world_from_object: Matrix) -> Sphere {
        Sphere { world_from_object, radius: 1.0, cut: None }
    }

    /// The exact `t`, with which the filter must not disagree.
    fn intersect(sphere: &Sphere, ray: &Ray) -> Option<f64> {
        let exact = sphere.exact(ray).map(|t| t.bracket());
        match (sphere.filter(&FilterRay::new(ray)), exact) {
            (Verdict::Miss, None) | (Verdict::Unsure, _) => {}
            (Verdict::Hit(filtered), Some(exact)) => {
                assert!(filtered.low <= exact.high && exact.low <= filtered.high, "{filtered:?} is not {exact:?}");
            }
            (verdict, _) => panic!("{verdict:?} but {exact:?}"),
        }
        exact.map(|bracket| 0.5 * (bracket.low + bracket.high))
    }

    fn along_z(x: f64, y: f64, z: f64) -> Ray {
        Ray { origin: Point::new(x, y, z), direction: Vector::new(0.0, 0.0, 1.0) }
    }

    #[test]
    fn the_nearest_positive_root_counts() {
        let sphere = unit(Matrix::translate([0.0, 0.0, 5.0]));
        assert_eq!(intersect(&sphere, &along_z(0.0, 0.0, 0.0)), Some(4.0));
        assert_eq!(intersect(&sphere, &along_z(0.0, 0.0, 5.0)), Some(1.0), "from the centre");
        assert_eq!(intersect(&sphere, &along_z(0.0, 0.0, 5.5)), Some(0.5), "from within");
        assert_eq!(intersect(&sphere, &along_z(0.0, 0.0, 4.0)), Some(2.0), "from the surface inwards");
        assert_eq!(intersect(&sphere, &along_z(0.0, 0.0, 6.0)), None, "from the surface outwards");
        assert_eq!(intersect(&sphere, &along_z(0.0, 0.0, 7.0)), None, "behind");
    }

    #[test]
    fn a_tangent_ray_hits() {
        let sphere = unit(Matrix::translate([0.0, 0.0, 5.0]));
        assert_eq!(intersect(&sphere, &along_z(1.0, 0.0, 0.0)), Some(5.0));
        assert_eq!(intersect(&sphere, &along_z(1.0f64.next_up(), 0.0, 0.0)), None);
    }

    #[test]
    fn transforms_stretch_and_mirror() {
        let stretched = unit(Matrix::translate([0.0, 0.0, 5.0]).times(&Matrix::scale([2.0, -3.0, 0.5])));
        assert_eq!(intersect(&stretched, &along_z(0.0, 0.0, 0.0)), Some(4.5));
        assert_eq!(intersect(&stretched, &along_z(2.0, 0.0, 0.0)), Some(5.0));
        let bounds = stretched.bounds();
        assert!(bounds.low.y < -3.0 && bounds.low.y > -3.0001 && bounds.high.z > 5.5 && bounds.high.z < 5.5001);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        /// An ellipsoid reaches r |row| from its centre along an axis, exactly.
        #[test]
        fn boxes_hold_the_sphere(
            entries in prop::array::uniform12(-1.0f64..1.0),
            exponents in prop::array::uniform12(-1040i32..1020),
            spread in 0usize..4,
            radius in 0.5f64..1.0,
            size in -1040i32..1020,
        ) {
            let power = |exponent: i32| times_power_of_two(1.0, exponent);
            // All of one size, a size for each row, for each entry, or all near the least number.
            let exponent = |i: usize, j: usize| match spread {
                0 => exponents[0],
                1 => exponents[i],
                2 => exponents[4 * i + j],
                _ => -1060 + exponents[4 * i + j] / 80,
            };
            let row = |i: usize| std::array::from_fn(|j| entries[4 * i + j] * power(exponent(i, j)));
            let radius = radius * power(if spread < 3 { size } else { 0 });
            let sphere = Sphere { radius, ..unit(Matrix { rows: [row(0), row(1), row(2)] }) };
            let bounds = sphere.bounds();
            for k in 0..3 {
                let row = sphere.world_from_object.rows[k];
                let linear = ExactVector::from([row[0], row[1], row[2]]);
                let square = &linear.dot(&linear) * &Dyadic::from(radius).square();
                let holds = |end: f64| (&Dyadic::from(end) - &Dyadic::from(row[3])).square() >= square;
                let (low, high) = (bounds.low[k], bounds.high[k]);
                prop_assert!(low == f64::NEG_INFINITY || holds(low), "{bounds:?}");
                prop_assert!(high == f64::INFINITY || holds(high), "{bounds:?}");
            }
        }
    }

    #[test]
    fn scales_of_any_size_work() {
        for size in [1e-300, 1e-150, 1e-20, 1e20, 1e150, 1e300] {
            let sphere = unit(Matrix::scale([size, size, size]));
            let bounds = sphere.bounds();
            assert!(sphere.can_be_hit() && bounds.low.x < -size && bounds.low.x > -1.0001 * size, "{size}");
        }
        assert!(!unit(Matrix::scale([1.0, 0.0, 1.0])).can_be_hit());
        assert!(!Sphere { radius: -1.0, ..unit(Matrix::IDENTITY) }.can_be_hit());
        assert!(!Sphere { radius: f64::NAN, ..unit(Matrix::IDENTITY) }.can_be_hit());
    }
}
