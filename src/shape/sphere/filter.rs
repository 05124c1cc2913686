//! The test in `f64` with bounds on its errors.

use super::Sphere;
use super::cut::{Cut, Plane};
use crate::exact::{Approximation, UNIT_ROUNDOFF as U};
use crate::geometry::{Matrix, Point, Vector};
use crate::shape::{FilterRay, Verdict};
use std::array::from_fn;
use std::cmp::Ordering::{Greater, Less};

type Approximations = [Approximation; 3];

/// The sphere and a ray in object space, times a positive factor and the sign of the determinant of M.
///
/// With m the linear part of M divided by a power of two s, so that its largest entry is about 1, A its adjugate, o' =
/// A (o - c), d' = A d and R = r s |det m|, the sphere is |o' + t d'| = R: nothing is divided, and few products leave
/// the range. A point q of object space is o' + t d' divided by s det m.
struct ScaledSpace {
    origin: Approximations,
    direction: Approximations,
    /// R.
    radius: Approximation,
    /// s det m.
    determinant: Approximation,
}

impl Sphere {
    /// Whether `ray` meets what there is of the sphere, and where first, as far as `f64` can tell (rule E2).
    ///
    /// The discriminant is taken as R^2 |d'|^2 - |o' x d'|^2, which keeps its digits where b^2 - ac loses them, and the
    /// roots in the form that adds numbers of one sign (Haines et al., "Precision Improvements for Ray/Sphere
    /// Intersection", Ray Tracing Gems, 2019). Every number carries a bound on its error.
    pub fn filter(&self, ray: &FilterRay) -> Verdict {
        let space = ScaledSpace::new(self, ray);
        let Some(roots) = space.roots() else { return Verdict::Unsure };
        for t in roots.into_iter().flatten() {
            match self.cut.as_ref().map_or(Some(true), |cut| space.is_there(t, cut)) {
                Some(true) => {
                    let bracket = t.bracket();
                    return if bracket.low > 0.0 { Verdict::Hit(bracket) } else { Verdict::Unsure };
                }
                Some(false) => {}
                None => return Verdict::Unsure,
            }
        }
        Verdict::Miss
    }
}

/// More than underflow can do to an entry of the adjugate: the entries of m, below 2, are off by 2^-1075 where they were
/// scaled down to less than a normal number, and each of two products loses as much again, 10 * 2^-1075 in all. The
/// first column of m, by which the determinant is computed, adds 24 * 2^-1075.
const ENTRY_UNDERFLOW: f64 = f64::from_bits(1 << 5);

/// The linear part of a matrix divided by a power of two, and its adjugate, with the sums of the absolute terms.
struct Adjugate {
    /// The first column of m, which with the first row of the adjugate gives the determinant.
    column: Vector,
    rows: [Vector; 3],
    terms: [Vector; 3],
}

impl Adjugate {
    fn new(m: &Matrix, scale: f64) -> Adjugate {
        let [x, y, z] = [0, 1, 2].map(|j| Vector::from(m.column(j).map(|entry| entry / scale)));
        let terms = [y.absolute_cross(z), z.absolute_cross(x), x.absolute_cross(y)];
        Adjugate { column: x, rows: [y.cross(z), z.cross(x), x.cross(y)], terms }
    }

    /// Row `k` times `v`, of which each component may be rounded once. An entry passes two roundings, and three more
    /// follow: six units of 2^-53 of the absolute terms, and two for the roundings of the bound.
    fn row_times(&self, k: usize, v: Vector) -> Approximation {
        let size = v.absolute();
        let underflow = ENTRY_UNDERFLOW * (size.x + size.y + size.z + 1.0);
        Approximation::within(self.rows[k].dot(v), 8.0 * U * self.terms[k].dot(size) + underflow)
    }
}

impl ScaledSpace {
    fn new(sphere: &Sphere, ray: &FilterRay) -> ScaledSpace {
        let m = &sphere.world_from_object;
        let scale = sphere.scale();
        let adjugate = Adjugate::new(m, scale);
        let determinant = adjugate.row_times(0, adjugate.column) * Approximation::exactly(scale);
        let from_centre = ray.ray.origin - Point::from(m.column(3));
        ScaledSpace {
            origin: from_fn(|k| adjugate.row_times(k, from_centre)),
            direction: from_fn(|k| adjugate.row_times(k, ray.ray.direction)),
            radius: Approximation::exactly(sphere.radius) * determinant.abs(),
            determinant,
        }
    }

    /// The positive roots, the nearer one first; `None` where it is not sure how many there are.
    fn roots(&self) -> Option<[Option<Approximation>; 2]> {
        let (o, d) = (&self.origin, &self.direction);
        let square_of_radius = self.radius.square();
        let b = dot(o, d);
        let c = dot(o, o) - square_of_radius;
        let outside = c.sign()? == Greater;
        if outside && b.sign() == Some(Greater) {
            // Both roots, if there are any, are negative.
            return Some([None, None]);
        }
        let a = dot(d, d);
        let moment = cross(o, d);
        let discriminant = square_of_radius * a - dot(&moment, &moment);
        if outside {
            if discriminant.sign()? == Less {
                return Some([None, None]);
            }
            // Both roots are positive only where b is negative. It is far from 0 where the discriminant is, so this is
            // for the reader's peace of mind.
            b.sign().filter(|sign| *sign == Less)?;
            let sum = discriminant.square_root() - b;
            return Some([Some(c.over(sum)), Some(sum.over(a))]);
        }
        // From within, the discriminant is positive, and one root is behind. Where the sign of b is not sure, both forms
        // are good.
        let root = discriminant.square_root();
        let t = if b.sign() == Some(Greater) { (-c).over(b + root) } else { (root - b).over(a) };
        Some([Some(t), None])
    }

    /// Whether the cut leaves the point at `t`.
    fn is_there(&self, t: Approximation, cut: &Cut) -> Option<bool> {
        let sign = self.determinant.sign()?;
        let point: Approximations = from_fn(|k| self.origin[k] + t * self.direction[k]);
        let side = |plane: &Plane| {
            let offset = Approximation::exactly(plane.offset) * self.determinant;
            let difference = dot(&plane.normal.map(Approximation::exactly), &point) - offset;
            difference.sign().map(|side| if sign == Less { side.reverse() } else { side })
        };
        cut.holds(side)
    }
}

fn dot(a: &Approximations, b: &Approximations) -> Approximation {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Approximations, b: &Approximations) -> Approximations {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Dyadic, ExactVector, times_power_of_two};
    use crate::geometry::Ray;
    use proptest::prelude::*;
    use std::cmp::Ordering;

    /// Numbers with all their bits, whole ones, and ones of other sizes.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            4 => -1.0f64..1.0,
            2 => (-3i32..4).prop_map(f64::from),
            1 => (-1.0f64..1.0, -1060i32..400).prop_map(|(x, exponent)| {
                times_power_of_two(x, exponent)
            }),
        ]
    }

    fn vector() -> impl Strategy<Value = Vector> {
        prop::array::uniform3(number()).prop_map(Vector::from)
    }

    fn matrix() -> impl Strategy<Value = Matrix> {
        let row = || prop::array::uniform4(number());
        [row(), row(), row()].prop_map(|rows| Matrix { rows })
    }

    fn cut() -> impl Strategy<Value = Option<Cut>> {
        let z = || prop::sample::select(vec![-1.0, -0.3, 0.0, 0.4, 1.0]);
        let phi = prop::sample::select(vec![0.0, 60.0, 180.0, 250.0, 360.0]);
        (z(), z(), phi).prop_map(|(low, high, phi)| Cut::new(1.0, low, high, phi))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn adjugates_stay_within_their_bounds(m in matrix(), origin in vector(), centre in vector()) {
            let sphere = Sphere { world_from_object: m, radius: 1.0, cut: None };
            let scale = sphere.scale();
            let adjugate = Adjugate::new(&m, scale);
            let (rows, determinant) = m.exact_adjugate();
            let square_of_scale = Dyadic::from(scale).square();
            let meant = |k: usize| {
                let v = ExactVector::from(origin).minus(&ExactVector::from(centre));
                rows[k].dot(&v)
            };
            for k in 0..3 {
                let found = adjugate.row_times(k, Point::from(origin.to_array()) - Point::from(centre.to_array()));
                // Compared after both are multiplied by the square of the scale.
                let ends = found.bracket();
                let times_scale = |end: f64| &Dyadic::from(end) * &square_of_scale;
                prop_assert!(!ends.low.is_finite() || times_scale(ends.low) <= meant(k), "row {k}");
                prop_assert!(!ends.high.is_finite() || times_scale(ends.high) >= meant(k), "row {k}");
            }
            let found = adjugate.row_times(0, adjugate.column).bracket();
            let times_scale = |end: f64| &(&Dyadic::from(end) * &square_of_scale) * &Dyadic::from(scale);
            prop_assert!(!found.low.is_finite() || times_scale(found.low) <= determinant);
            prop_assert!(!found.high.is_finite() || times_scale(found.high) >= determinant);
        }

        /// Rays at the sphere, past it and along its surface: whatever the filter says of them is so.
        #[test]
        fn verdicts_are_right(
            m in matrix(),
            radius in prop::sample::select(vec![1.0, 0.7, 1e-30, 1e200]),
            cut in cut(),
            origin in vector(),
            on_sphere in prop::sample::select(vec![[0.6, 0.8, 0.0], [0.0, -1.0, 0.0], [0.48, 0.6, 0.64], [0.1, 0.2, 0.3]]),
            aside in prop::sample::select(vec![0.0, 0.0, 1e-15, 1e-8, 0.3]),
        ) {
            let sphere = Sphere { world_from_object: m, radius, cut: if radius == 1.0 { cut } else { None } };
            prop_assume!(sphere.can_be_hit());
            let target = m.apply(Point::from(on_sphere.map(|q| q * radius * (1.0 + aside))));
            let origin = Point::default() + origin;
            let ray = Ray { origin, direction: target - origin };
            prop_assume!(ray.can_hit());
            match (sphere.filter(&FilterRay::new(&ray)), sphere.exact(&ray)) {
                (Verdict::Unsure, _) | (Verdict::Miss, None) => {}
                (Verdict::Hit(bracket), Some(t)) => {
                    prop_assert!(t.compare_with(&Dyadic::from(bracket.low)) != Ordering::Less);
                    let is_high = !bracket.high.is_finite() || t.compare_with(&Dyadic::from(bracket.high)) != Ordering::Greater;
                    prop_assert!(is_high);
                }
                (verdict, t) => prop_assert!(false, "{verdict:?}, but {t:?}"),
            }
        }
    }
}
