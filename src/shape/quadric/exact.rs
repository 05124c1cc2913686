//! The quadric test in exact arithmetic.

use super::cut::{Cut, Plane};
use super::{Disk, Form, Quadric};
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::{Matrix, Ray};
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
    /// counts (rules E2, E5 and E6). The surface [can be hit](Quadric::can_be_hit), and the ray is
    /// finite and has a direction.
    pub fn exact(&self, ray: &Ray) -> Option<Root> {
        let space = ScaledSpace::new(self, ray);
        let (o, d) = (&space.origin, &space.direction);
        let first = |roots: Option<[Root; 2]>, is_there: &dyn Fn(&Root) -> bool| {
            roots?
                .into_iter()
                .find(|t| t.sign() == Ordering::Greater && is_there(t))
        };
        match &self.form {
            Form::Sphere(cut) => {
                let is_there = |t: &Root| cut.as_ref().is_none_or(|cut| space.is_there(t, cut));
                first(space.distances_from_middle(o, d, self.radius), &is_there)
            }
            Form::Cylinder(cut) => first(
                space.distances_from_middle(&across(o), &across(d), self.radius),
                &|t| space.is_there(t, cut),
            ),
            Form::Disk(disk) => space.crossing(disk, self.radius),
        }
    }

    /// How far `ray` is from merely touching the whole sphere or cylinder: (b^2 - a c) / b^2 of its
    /// equation a t^2 + 2 b t + c = 0, rounded to the nearest `f64`. It is 0 if the ray touches,
    /// negative if it misses, and more than 1 from inside. `None` for a disk, and if b is 0. The
    /// surface [can be hit](Quadric::can_be_hit), and the ray is finite.
    pub fn clearance(&self, ray: &Ray) -> Option<f64> {
        let space = ScaledSpace::new(self, ray);
        let (o, d) = (&space.origin, &space.direction);
        let [a, b, c] = match &self.form {
            Form::Sphere(_) => space.equation(o, d, self.radius),
            Form::Cylinder(_) => space.equation(&across(o), &across(d), self.radius),
            Form::Disk(_) => return None,
        };
        let square = b.square();
        (!square.is_zero()).then(|| (&square - &(&a * &c)).quotient_to_f64(&square))
    }
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
        let apply = |v: &ExactVector| ExactVector::new([0, 1, 2].map(|k| adjugate[k].dot(v)));
        ScaledSpace {
            origin: apply(&origin),
            direction: apply(&direction),
            determinant,
        }
    }

    /// The two t with |o + t d| = R, in order; `None` if there are none, or d is 0.
    fn distances_from_middle(
        &self,
        o: &ExactVector,
        d: &ExactVector,
        radius: f64,
    ) -> Option<[Root; 2]> {
        let [a, b, c] = self.equation(o, d, radius);
        if a.is_zero() {
            None
        } else {
            Root::of_quadratic(&a, &b, &c)
        }
    }

    /// The a, b and c of the equation a t^2 + 2 b t + c = 0 for these t.
    fn equation(&self, o: &ExactVector, d: &ExactVector, radius: f64) -> [Dyadic; 3] {
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

    /// The `t` at which the ray crosses the plane of `disk`, if it is positive and within the disk.
    fn crossing(&self, disk: &Disk, radius: f64) -> Option<Root> {
        let slope = &self.direction[2];
        if slope.is_zero() {
            return None;
        }
        let rise = &(&Dyadic::from(disk.height) * &self.determinant) - &self.origin[2];
        // The point and its distance from the axis, both times the slope.
        let point = across(&self.origin)
            .times(slope)
            .plus(&across(&self.direction).times(&rise));
        let distance = point.dot(&point);
        let from_axis = |limit: f64| {
            let limit = &(&Dyadic::from(limit) * &self.determinant) * slope;
            Some(distance.cmp(&limit.square()))
        };
        let t = Root::ratio(rise, slope.clone());
        let is_there = disk.holds(radius, from_axis, |plane| Some(self.side(&t, plane)));
        (t.sign() == Ordering::Greater && is_there.expect("every side is known")).then_some(t)
    }
}
