//! The test in `f64` with bounds on its errors.

use super::cut::{Cut, Plane};
use super::{Disk, Form, Quadric};
use crate::exact::{Approximation, UNIT_ROUNDOFF as U};
use crate::geometry::{Matrix, Point, Vector};
use crate::shape::{FilterRay, Verdict};
use std::array::from_fn;
use std::cmp::Ordering::{self, Greater, Less};

type Approximations = [Approximation; 3];
/// The positive roots of an equation, the nearer one first; `None` where it is not sure how many there are.
type Roots = Option<[Option<Approximation>; 2]>;

/// A surface and a ray in object space, times a positive factor and the sign of the determinant of M.
///
/// With m the linear part of M divided by a power of two s, so that its largest entry is about 1, A its adjugate, o' =
/// A (o - c), d' = A d and R = r s |det m|, the ray is o' + t d', and R the radius: nothing is divided, and few products leave
/// the range. A point q of object space is o' + t d' divided by s det m.
struct ScaledSpace {
    origin: Approximations,
    direction: Approximations,
    /// R.
    radius: Approximation,
    /// s det m.
    determinant: Approximation,
}

impl Quadric {
    /// Whether `ray` meets what there is of the surface, and where first, as far as `f64` can tell (rules E2, E5 and E6).
    ///
    /// The discriminant is taken as R^2 |d'|^2 - |o' x d'|^2, which keeps its digits where b^2 - ac loses them, and the
    /// roots in the form that adds numbers of one sign (Haines et al., "Precision Improvements for Ray/Sphere
    /// Intersection", Ray Tracing Gems, 2019). Every number carries a bound on its error. A cylinder is a sphere of two dimensions.
    pub fn filter(&self, ray: &FilterRay) -> Verdict {
        let space = ScaledSpace::new(self, ray);
        let (o, d) = (&space.origin, &space.direction);
        match &self.form {
            Form::Sphere(None) => first_hit(space.roots(o, d), |_| Some(true)),
            Form::Sphere(Some(cut)) => first_hit(space.roots(o, d), |t| space.is_there(t, cut)),
            Form::Cylinder(cut) => match first_hit(space.roots(&across(o), &across(d)), |t| space.is_there(t, cut)) {
                Verdict::Unsure if space.misses_between_ends(cut) => Verdict::Miss,
                verdict => verdict,
            },
            Form::Disk(disk) => first_hit(space.crossing(disk), |t| space.is_in_ring(t, disk, self.radius)),
        }
    }
}

/// The first of the roots that is there.
#[inline]
fn first_hit(roots: Roots, is_there: impl Fn(Approximation) -> Option<bool>) -> Verdict {
    let Some(roots) = roots else { return Verdict::Unsure };
    for t in roots.into_iter().flatten() {
        match is_there(t) {
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

/// What of a vector is across the z axis.
fn across(v: &Approximations) -> Approximations {
    [v[0], v[1], Approximation::exactly(0.0)]
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
    fn new(quadric: &Quadric, ray: &FilterRay) -> ScaledSpace {
        let m = &quadric.world_from_object;
        let scale = quadric.scale();
        let adjugate = Adjugate::new(m, scale);
        let determinant = adjugate.row_times(0, adjugate.column) * Approximation::exactly(scale);
        let from_centre = ray.ray.origin - Point::from(m.column(3));
        ScaledSpace {
            origin: from_fn(|k| adjugate.row_times(k, from_centre)),
            direction: from_fn(|k| adjugate.row_times(k, ray.ray.direction)),
            radius: Approximation::exactly(quadric.radius) * determinant.abs(),
            determinant,
        }
    }

    /// The t with |o + t d| = R, where o and d are those of the ray or what of them is across the axis.
    fn roots(&self, o: &Approximations, d: &Approximations) -> Roots {
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
            // Both roots are positive only where b is negative. Of a sphere it is far from 0 where the discriminant is, so this is
            // for the reader's peace of mind.
            b.sign().filter(|sign| *sign == Less)?;
            let sum = discriminant.square_root() - b;
            return Some([Some(c.over(sum)), Some(sum.over(a))]);
        }
        // From within, the discriminant is positive, and one root is behind; but if d is 0 across the axis, there is none, and a
        // division by 0 says nothing. Where the sign of b is not sure, both forms are good.
        let root = discriminant.square_root();
        let t = if b.sign() == Some(Greater) { (-c).over(b + root) } else { (root - b).over(a) };
        Some([Some(t), None])
    }

    /// Where the ray crosses the plane of `disk`.
    fn crossing(&self, disk: &Disk) -> Roots {
        let rise = self.above(disk.height);
        let slope = self.direction[2];
        let is_ahead = rise.sign()? == slope.sign()?;
        Some([is_ahead.then(|| rise.over(slope)), None])
    }

    /// How far, along the axis, the plane at `height` is from the origin of the ray.
    fn above(&self, height: f64) -> Approximation {
        Approximation::exactly(height) * self.determinant - self.origin[2]
    }

    fn point(&self, t: Approximation) -> Approximations {
        from_fn(|k| self.origin[k] + t * self.direction[k])
    }

    /// Whether the cut leaves the point at `t`.
    fn is_there(&self, t: Approximation, cut: &Cut) -> Option<bool> {
        let point = self.point(t);
        let sign = self.determinant.sign()?;
        cut.holds(|plane| self.side(&point, sign, plane))
    }

    /// On which side of `plane` a point is, given the sign of the determinant.
    fn side(&self, point: &Approximations, sign: Ordering, plane: &Plane) -> Option<Ordering> {
        let offset = Approximation::exactly(plane.offset) * self.determinant;
        let difference = dot(&plane.normal.map(Approximation::exactly), point) - offset;
        difference.sign().map(|side| if sign == Less { side.reverse() } else { side })
    }

    /// Whether the point at `t`, which is in the plane of `disk`, is there.
    fn is_in_ring(&self, t: Approximation, disk: &Disk, radius: f64) -> Option<bool> {
        let point = self.point(t);
        let sign = self.determinant.sign()?;
        let [x, y, _] = point;
        let distance = x.square() + y.square();
        let from_axis = |limit: f64| (distance - (Approximation::exactly(limit) * self.determinant).square()).sign();
        disk.holds(radius, from_axis, |plane| self.side(&point, sign, plane))
    }

    /// Whether the ray surely misses a cylinder between its ends, which the roots cannot tell where it is nearly parallel to the axis.
    /// Between the planes of the ends it is a segment: it misses where that is within the circle, or beyond a tangent of it.
    fn misses_between_ends(&self, cut: &Cut) -> bool {
        let end = |z: f64| across(&self.point(self.above(z).over(self.direction[2])));
        let (p, q) = (end(cut.z_min), end(cut.z_max));
        let square_of_radius = self.radius.square();
        let is = |difference: Approximation, sign: Ordering| difference.sign() == Some(sign);
        let pp = dot(&p, &p);
        let is_within = is(pp - square_of_radius, Less) && is(dot(&q, &q) - square_of_radius, Less);
        // The tangent across p: the circle reaches R |p| along p.
        let pq = dot(&p, &q);
        let is_beside =
            is(pp - square_of_radius, Greater) && is(pq, Greater) && is(pq.square() - square_of_radius * pp, Greater);
        is_within || is_beside
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

    /// Of a unit radius.
    fn form() -> impl Strategy<Value = Form> {
        let z = || prop::sample::select(vec![-1.0, -0.3, 0.0, 0.4, 1.0]);
        let phi = prop::sample::select(vec![0.0, 60.0, 180.0, 250.0, 360.0]);
        (z(), z(), phi, 0..5).prop_map(|(low, high, phi, kind)| match kind {
            0 => Form::Sphere(None),
            1 => Form::Sphere(Cut::new(1.0, low, high, phi)),
            2 | 3 => Form::Cylinder(Cut::of_cylinder(low, high, phi)),
            _ => Form::Disk(Disk::new(low, high, phi)),
        })
    }

    /// The same for another radius.
    fn scaled(form: Form, radius: f64) -> Form {
        let cut = |cut: Cut| Cut { z_min: cut.z_min * radius, z_max: cut.z_max * radius, ..cut };
        match form {
            Form::Sphere(part) => Form::Sphere(part.map(cut)),
            Form::Cylinder(part) => Form::Cylinder(cut(part)),
            Form::Disk(disk) => {
                Form::Disk(Disk { height: disk.height * radius, inner_radius: disk.inner_radius * radius, ..disk })
            }
        }
    }

    /// A point of the surface, or beside it where `aside` is not 0, given one of the unit sphere.
    fn target(form: &Form, [x, y, z]: [f64; 3], radius: f64, aside: f64) -> Point {
        let along = radius * (1.0 + aside);
        match form {
            Form::Sphere(_) => Point::new(x * along, y * along, z * along),
            Form::Cylinder(_) => {
                let from_axis = x.hypot(y).max(0.1);
                Point::new(x / from_axis * along, y / from_axis * along, z * radius)
            }
            Form::Disk(disk) => Point::new(x * along, y * along, disk.height),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn adjugates_stay_within_their_bounds(m in matrix(), origin in vector(), centre in vector()) {
            let quadric = Quadric { world_from_object: m, radius: 1.0, form: Form::Sphere(None) };
            let scale = quadric.scale();
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

        /// Rays at the surface, past it and along it: whatever the filter says of them is so.
        #[test]
        fn verdicts_are_right(
            m in matrix(),
            radius in prop::sample::select(vec![1.0, 0.7, 1e-30, 1e200]),
            form in form(),
            origin in vector(),
            on_sphere in prop::sample::select(vec![[0.6, 0.8, 0.0], [0.0, -1.0, 0.0], [0.48, 0.6, 0.64], [0.1, 0.2, 0.3]]),
            aside in prop::sample::select(vec![0.0, 0.0, 1e-15, 1e-8, 0.3]),
            slant in prop::sample::select(vec![None, None, None, Some(0.0), Some(1e-16), Some(1e-9), Some(0.1)]),
        ) {
            let form = scaled(form, radius);
            let quadric = Quadric { world_from_object: m, radius, form };
            prop_assume!(quadric.can_be_hit());
            let target = m.apply(target(&form, on_sphere, radius, aside));
            let (origin, direction) = match slant {
                None => (Point::default() + origin, target - (Point::default() + origin)),
                // Along the axis, or nearly so.
                Some(slant) => {
                    let axis = Vector::from([0, 1, 2].map(|k| m.rows[k][2] + slant * m.rows[k][0]));
                    (target + -(axis * radius), axis)
                }
            };
            let ray = Ray { origin, direction };
            prop_assume!(ray.can_hit());
            match (quadric.filter(&FilterRay::new(&ray)), quadric.exact(&ray)) {
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

    /// Rays parallel to the axis, which no root tells of.
    #[test]
    fn nothing_is_left_open_where_a_cylinder_is_seen_along_its_axis() {
        let tilted = Matrix { rows: [[0.6, 0.0, 0.8, 0.1], [0.0, 1.0, 0.0, 0.2], [-0.8, 0.0, 0.6, 0.3]] };
        for world_from_object in [Matrix::IDENTITY, tilted, Matrix::scale([1.0, 1.0, 1e-9])] {
            let form = Form::Cylinder(Cut::of_cylinder(-1.0, 2.0, 300.0));
            let quadric = Quadric { world_from_object, radius: 1.0, form };
            for [x, y] in [[0.0, 0.0], [0.9, 0.1], [0.7, -0.7], [0.8, 0.8], [1.1, 0.0], [-3.0, 2.0]] {
                let origin = world_from_object.apply(Point::new(x, y, -5.0));
                let ray = Ray { origin, direction: Vector::from(world_from_object.column(2)) };
                assert_eq!(quadric.filter(&FilterRay::new(&ray)), Verdict::Miss, "{x} {y} {world_from_object:?}");
            }
        }
    }
}
