//! The quadric test in exact arithmetic.

mod revolution;

use super::cut::{Cut, Plane};
use super::revolved::Equation;
use super::{Disk, Form, Quadric};
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::{Matrix, Ray};
use crate::per_axis::per_axis;
use std::cmp::Ordering;

/// A ray in object space, times the determinant of M, which avoids divisions.
///
/// With A the adjugate of the linear part of M, it is o' + t d' with o' = A (o - c) and d' = A d; R
/// = r |det M|.
pub(in crate::shape) struct ScaledSpace {
    pub(in crate::shape) origin: ExactVector,
    pub(in crate::shape) direction: ExactVector,
    pub(in crate::shape) determinant: Dyadic,
}

impl Quadric {
    /// The smallest positive `t` at which `ray` meets the surface; touching a sphere or a cylinder
    /// counts (rules E2, E5, E6 and E8 to E11). The surface [can be hit](Quadric::can_be_hit), and
    /// the ray is finite and has a direction.
    pub fn exact(&self, ray: &Ray) -> Option<Root> {
        self.exact_number(ray, 0)
    }

    /// The same for the hit of number `number`, counted from 0 in the order of `t`.
    pub fn exact_number(&self, ray: &Ray, number: usize) -> Option<Root> {
        if let Form::Patch = self.form {
            return self.patch().exact(ray, number);
        }
        let space = ScaledSpace::new(self, ray);
        let first = |is_there: &dyn Fn(&Root) -> bool| {
            let roots = space.equation(self).and_then(roots_of);
            roots
                .into_iter()
                .flatten()
                .flatten()
                .filter(|t| t.sign() == Ordering::Greater && is_there(t))
                .nth(number)
        };
        match &self.form {
            Form::Sphere(None) => first(&|_| true),
            Form::Sphere(Some(cut)) | Form::Cylinder(cut) => first(&|t| space.is_there(t, cut)),
            Form::Revolved(revolved) => first(&|t| space.is_on_revolved(t, revolved)),
            Form::Disk(disk) if number == 0 => space.crossing(disk, self.radius),
            Form::Disk(_) | Form::Patch => None,
        }
    }

    /// The same of the whole surface that it is a part of: of a disk, the plane. Of a patch, there
    /// is no whole.
    pub(crate) fn exact_whole(&self, ray: &Ray) -> Option<Root> {
        if let Form::Patch = self.form {
            return None;
        }
        let space = ScaledSpace::new(self, ray);
        let is_ahead = |t: &Root| t.sign() == Ordering::Greater;
        match &self.form {
            Form::Disk(disk) => space.crossing_of_plane(disk).filter(is_ahead),
            _ => {
                let roots = roots_of(space.equation(self)?)?;
                roots.into_iter().flatten().find(is_ahead)
            }
        }
    }

    /// How far `ray` is from merely touching the whole sphere, cylinder or surface of revolution:
    /// (b^2 - a c) / b^2 of its equation a t^2 + 2 b t + c = 0, rounded to the nearest `f64`. It is
    /// 0 if the ray touches, negative if it misses, and more than 1 from inside a sphere or a
    /// cylinder. `None` for a disk or a patch, and if b is 0. The surface [can be
    /// hit](Quadric::can_be_hit), and the ray is finite.
    pub fn clearance(&self, ray: &Ray) -> Option<f64> {
        if let Form::Patch = self.form {
            return None;
        }
        let [a, b, c] = ScaledSpace::new(self, ray).equation(self)?;
        let square = b.square();
        (!square.is_zero()).then(|| (&square - &(&a * &c)).quotient_to_f64(&square))
    }
}

/// The roots of a t^2 + 2 b t + c = 0 in order; `None` if there are none, or any t is one.
fn roots_of([a, b, c]: [Dyadic; 3]) -> Option<[Option<Root>; 2]> {
    if a.is_zero() {
        let twice = &b + &b;
        return (!b.is_zero()).then(|| [Some(Root::ratio(-&c, twice)), None]);
    }
    let roots = match a.sign() {
        Ordering::Less => Root::of_quadratic(&-&a, &-&b, &-&c),
        _ => Root::of_quadratic(&a, &b, &c),
    };
    roots.map(|roots| roots.map(Some))
}

/// The components across the z axis.
fn across(v: &ExactVector) -> ExactVector {
    ExactVector::new([v[0].clone(), v[1].clone(), Dyadic::zero()])
}

impl ScaledSpace {
    fn new(quadric: &Quadric, ray: &Ray) -> ScaledSpace {
        ScaledSpace::of(&quadric.world_from_object, ray)
    }

    /// The space of `m`.
    pub(in crate::shape) fn of(m: &Matrix, ray: &Ray) -> ScaledSpace {
        let (adjugate, determinant) = m.exact_adjugate();
        let centre = ExactVector::from(m.column(3));
        let origin = ExactVector::from(ray.origin).minus(&centre);
        let direction = ExactVector::from(ray.direction);
        let apply = |v: &ExactVector| ExactVector::new(per_axis(|k| adjugate[k].dot(v)));
        ScaledSpace {
            origin: apply(&origin),
            direction: apply(&direction),
            determinant,
        }
    }

    /// The a, b and c of the equation a t^2 + 2 b t + c = 0 of the t at which the ray meets the
    /// whole surface; `None` for one that has none.
    fn equation(&self, quadric: &Quadric) -> Option<[Dyadic; 3]> {
        let (o, d) = (&self.origin, &self.direction);
        match &quadric.form {
            Form::Sphere(_) => Some(self.distances_from_middle(o, d, quadric.radius)),
            Form::Cylinder(_) => {
                Some(self.distances_from_middle(&across(o), &across(d), quadric.radius))
            }
            Form::Revolved(revolved) => {
                Some(self.of_revolved(&Equation::of(revolved, quadric.radius)))
            }
            Form::Disk(_) | Form::Patch => None,
        }
    }

    /// The equation of |o + t d| = R.
    fn distances_from_middle(&self, o: &ExactVector, d: &ExactVector, radius: f64) -> [Dyadic; 3] {
        let radius = &Dyadic::from(radius) * &self.determinant;
        [d.dot(d), o.dot(d), &o.dot(o) - &radius.square()]
    }

    /// Whether the point at `t` belongs to the part.
    fn is_there(&self, t: &Root, cut: &Cut) -> bool {
        cut.holds(|plane| Some(self.side(t, plane)))
            .expect("every side is known")
    }

    /// The side of `plane` on which the point at `t` is. A negative determinant reverses every
    /// sign.
    fn side(&self, t: &Root, plane: &Plane) -> Ordering {
        let normal = ExactVector::from(plane.normal);
        let offset = &Dyadic::from(plane.offset) * &self.determinant;
        let sign = t.sign_of_linear(
            &(&normal.dot(&self.origin) - &offset),
            &normal.dot(&self.direction),
        );
        if self.determinant.sign() == Ordering::Less {
            sign.reverse()
        } else {
            sign
        }
    }

    /// How far the plane of `disk` is along the axis from the origin of the ray.
    fn rise(&self, disk: &Disk) -> Dyadic {
        &(&Dyadic::from(disk.height) * &self.determinant) - &self.origin[2]
    }

    /// The `t` at which the ray crosses the plane of `disk`.
    fn crossing_of_plane(&self, disk: &Disk) -> Option<Root> {
        let slope = &self.direction[2];
        (!slope.is_zero()).then(|| Root::ratio(self.rise(disk), slope.clone()))
    }

    /// The `t` at which the ray crosses the plane of `disk`, if it is positive and within the disk.
    fn crossing(&self, disk: &Disk, radius: f64) -> Option<Root> {
        let t = self.crossing_of_plane(disk)?;
        let (slope, rise) = (&self.direction[2], self.rise(disk));
        // The point and its distance from the axis, both times the slope.
        let point = across(&self.origin)
            .times(slope)
            .plus(&across(&self.direction).times(&rise));
        let distance = point.dot(&point);
        let from_axis = |limit: f64| {
            let limit = &(&Dyadic::from(limit) * &self.determinant) * slope;
            Some(distance.cmp(&limit.square()))
        };
        let is_there = disk.holds(radius, from_axis, |plane| Some(self.side(&t, plane)));
        (t.sign() == Ordering::Greater && is_there.expect("every side is known")).then_some(t)
    }
}
