//! The normal of a triangle.

use super::Triangle;
use crate::exact::{ExactVector, UNIT_ROUNDOFF as U};
use crate::geometry::Vector;
use crate::per_axis::per_axis;

/// The relative error of a normal in `f64`: far below the rounding to `f32`.
const CLOSE: f64 = 1.0 / (1u64 << 40) as f64;

impl Triangle {
    /// The unit vector along (b - a) x (c - a), with corners a, b and c, with an error of at most
    /// 2^-40: in `f64` if that is certain, else computed exactly and rounded, so that slivers have
    /// normals, too. 0 for a triangle without area. The corners are finite.
    pub fn normal(&self) -> Vector {
        self.quick_normal()
            .or_else(|| self.exact_normal())
            .unwrap_or_default()
    }

    /// A component takes four roundings: both differences, a product, and the difference of
    /// products.
    fn quick_normal(&self) -> Option<Vector> {
        let [a, b, c] = self.0;
        let (ab, ac) = (b - a, c - a);
        let (normal, terms) = (ab.cross(ac), ab.absolute_cross(ac));
        let largest = normal.largest();
        // Within these limits its square neither overflows nor loses what matters, and no product
        // has underflowed.
        let in_range = largest > 1e-140 && terms.largest() < 1e140;
        (in_range && 8.0 * U * (terms.x + terms.y + terms.z) <= CLOSE * largest)
            .then(|| normal.normalized())
    }

    /// Like [`Triangle::normal`], with three roundings per component. `None` for a triangle without
    /// area.
    pub fn exact_normal(&self) -> Option<Vector> {
        let normal = self.exact_cross();
        let largest = (0..3)
            .map(|k| normal[k].clone().abs())
            .max()
            .filter(|largest| !largest.is_zero())?;
        Some(Vector::from(per_axis(|k| normal[k].quotient_to_f64(&largest))).normalized())
    }

    /// (b - a) x (c - a).
    pub(crate) fn exact_cross(&self) -> ExactVector {
        let [a, b, c] = self.0.map(ExactVector::from);
        b.minus(&a).cross(&c.minus(&a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use proptest::prelude::*;

    const CORNERS: [Point; 3] = [
        Point::new(0.0, 0.0, 2.0),
        Point::new(4.0, 0.0, 2.0),
        Point::new(0.0, 4.0, 2.0),
    ];

    #[test]
    fn is_that_of_a_right_hand() {
        let [a, b, c] = CORNERS;
        assert_eq!(Triangle([a, b, c]).normal(), Vector::new(0.0, 0.0, 1.0));
        assert_eq!(Triangle([a, c, b]).normal(), Vector::new(0.0, 0.0, -1.0));
        assert_eq!(Triangle([a, b, b]).normal(), Vector::default());
    }

    #[test]
    fn slivers_and_all_sizes_have_one() {
        let point = |x: f64, last: f64| Point::new(x, 3.0 * x, last);
        let sliver = Triangle([
            point(0.0, 0.0),
            point(1.0, 7.0),
            point(2.0, 14f64.next_up()),
        ]);
        assert!(sliver.quick_normal().is_none(), "collinear but for one bit");
        let (found, expected) = (sliver.normal(), Vector::new(3.0, -1.0, 0.0).normalized());
        assert!(
            (0..3).all(|k| (found[k] - expected[k]).abs() < 1e-15),
            "{found:?}"
        );
        for exponent in [-1060, -300, 0, 300, 1000] {
            let sized = |p: Point| {
                Point::from(
                    p.to_array()
                        .map(|x| crate::exact::times_power_of_two(x, exponent)),
                )
            };
            assert_eq!(
                Triangle(CORNERS.map(sized)).normal(),
                Vector::new(0.0, 0.0, 1.0),
                "2^{exponent}"
            );
        }
    }

    proptest! {
        #[test]
        fn the_quick_one_is_close_to_the_exact_one(
            corners in prop::array::uniform3(prop::array::uniform3(-1.0f64..1.0)),
            flatness in prop::sample::select(vec![1.0, 1e-3, 1e-4, 1e-9]),
            offset in prop::sample::select(vec![0.0, 1.0, 1e6]),
        ) {
            let triangle = Triangle(corners.map(|[x, y, z]| Point::new(x + offset, x + y * flatness, z * flatness)));
            if let (Some(quick), Some(exact)) = (triangle.quick_normal(), triangle.exact_normal()) {
                let off = Vector::new(quick.x - exact.x, quick.y - exact.y, quick.z - exact.z);
                prop_assert!(off.largest() <= CLOSE, "{triangle:?}: {quick:?} is not {exact:?}");
            }
        }
    }
}
