//! The test of a patch in exact arithmetic.

use super::Patch;
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::Ray;
use std::cmp::Ordering::{Equal, Greater, Less};

/// A vector that is a polynomial of the first degree in u.
struct Linear(ExactVector, ExactVector);

impl Linear {
    fn cross(&self, d: &ExactVector) -> Linear {
        Linear(self.0.cross(d), self.1.cross(d))
    }

    /// The coefficients of the scalar product, from the constant one up.
    fn dot(&self, other: &Linear) -> [Dyadic; 3] {
        let middle = &self.0.dot(&other.1) + &self.1.dot(&other.0);
        [self.0.dot(&other.0), middle, self.1.dot(&other.1)]
    }

    /// The coefficients of component `k` of the cross product.
    fn cross_component(&self, other: &Linear, k: usize) -> [Dyadic; 3] {
        let middle = self.0.cross(&other.1).plus(&self.1.cross(&other.0));
        let ends = [self.0.cross(&other.0), self.1.cross(&other.1)];
        [ends[0][k].clone(), middle[k].clone(), ends[1][k].clone()]
    }
}

impl Patch {
    /// The smallest positive `t` at which `ray` meets the patch (rule E11).
    /// That is the hit of number 0; the other one has number 1.
    pub(in crate::shape::quadric) fn exact(&self, ray: &Ray, number: usize) -> Option<Root> {
        let origin = ExactVector::from(ray.origin);
        let d = ExactVector::from(ray.direction);
        let [p00, p10, p01, p11] = self.corners.map(ExactVector::from);
        let first = p01.minus(&p00);
        let twist = p11.minus(&p10).minus(&first);
        let along = Linear(first, twist);
        let start = Linear(p00.minus(&origin), p10.minus(&p00));
        let us = roots_of(&start.dot(&along.cross(&d)));
        let met = us.into_iter().filter_map(|u| meet(&start, &along, &d, &u));
        let mut met: Vec<Root> = met.collect();
        met.sort();
        met.into_iter().nth(number)
    }
}

/// The `t` of the point of the ruling at `u` on the line of the ray, if it is in the patch and
/// ahead.
fn meet(start: &Linear, along: &Linear, d: &ExactVector, u: &Root) -> Option<Root> {
    let one = Dyadic::from(1.0);
    let is_in_u = u.sign() != Less && u.compare_with(&one) != Greater;
    is_in_u.then_some(())?;
    let n = along.cross(d);
    // A ruling along the ray, or of no length, has no component.
    let k = (0..3).find(|k| u.sign_of_linear(&n.0[*k], &n.1[*k]) != Equal)?;
    // (A x d) . n is -v |n|^2.
    let from_start = start.cross(d).dot(&n);
    let square = n.dot(&n);
    let from_end: [Dyadic; 3] = std::array::from_fn(|i| &from_start[i] + &square[i]);
    let is_in_v =
        u.sign_of_quadratic(&from_start) != Greater && u.sign_of_quadratic(&from_end) != Less;
    is_in_v.then_some(())?;
    let numerator = start.cross_component(along, k).map(|x| -&x);
    let denominator = [n.0[k].clone(), n.1[k].clone(), Dyadic::zero()];
    Some(u.quotient(&numerator, &denominator)).filter(|t| t.sign() == Greater)
}

/// The different roots of a quadratic polynomial; none if it is 0 everywhere.
fn roots_of([c0, c1, c2]: &[Dyadic; 3]) -> Vec<Root> {
    let twice = |x: &Dyadic| x + x;
    match c2.sign() {
        Equal if c1.is_zero() => Vec::new(),
        Equal => vec![Root::ratio(-c0, c1.clone())],
        Less => roots_of(&[-c0, -c1, -c2]),
        Greater => Root::of_quadratic(&twice(c2), c1, &twice(c0)).map_or(Vec::new(), Vec::from),
    }
}
