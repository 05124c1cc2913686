//! The test in exact arithmetic.

use super::Sphere;
use super::cut::{Cut, Plane};
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::Ray;
use std::cmp::Ordering;

/// The sphere and a ray in object space, times the determinant of M: there no division is needed.
///
/// With A the adjugate of the linear part of M, o' = A (o - c), d' = A d and R = r |det M|, the sphere is |o' + t d'| = R.
struct ScaledSpace {
    origin: ExactVector,
    direction: ExactVector,
    determinant: Dyadic,
}

impl Sphere {
    /// The smallest positive `t` at which `ray` meets what there is of the sphere, or `None`; a tangent ray meets it (rule
    /// E2). The sphere [can be hit](Sphere::can_be_hit), and the ray is finite and not a point.
    pub fn exact(&self, ray: &Ray) -> Option<Root> {
        let space = ScaledSpace::new(self, ray);
        let radius = &Dyadic::from(self.radius) * &space.determinant.clone().abs();
        let a = space.direction.dot(&space.direction);
        let b = space.origin.dot(&space.direction);
        let c = &space.origin.dot(&space.origin) - &radius.square();
        let is_there = |t: &Root| self.cut.as_ref().is_none_or(|cut| space.is_there(t, cut));
        let roots = Root::of_quadratic(&a, &b, &c)?;
        roots.into_iter().find(|t| t.sign() == Ordering::Greater && is_there(t))
    }
}

impl ScaledSpace {
    fn new(sphere: &Sphere, ray: &Ray) -> ScaledSpace {
        let (adjugate, determinant) = sphere.world_from_object.exact_adjugate();
        let centre = ExactVector::from(sphere.world_from_object.column(3));
        let origin = ExactVector::from(ray.origin).minus(&centre);
        let direction = ExactVector::from(ray.direction);
        let apply = |v: &ExactVector| ExactVector::new([0, 1, 2].map(|k| adjugate[k].dot(v)));
        ScaledSpace { origin: apply(&origin), direction: apply(&direction), determinant }
    }

    /// Whether the cut leaves the point at `t`. A determinant below 0 turns every sign round.
    fn is_there(&self, t: &Root, cut: &Cut) -> bool {
        let side = |plane: &Plane| {
            let normal = ExactVector::from(plane.normal);
            let offset = &Dyadic::from(plane.offset) * &self.determinant;
            let sign = t.sign_of_linear(&(&normal.dot(&self.origin) - &offset), &normal.dot(&self.direction));
            Some(if self.determinant.sign() == Ordering::Less { sign.reverse() } else { sign })
        };
        cut.holds(side).expect("every side is known")
    }
}
