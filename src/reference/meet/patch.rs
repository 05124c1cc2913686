//! Bilinear patches (rule E11).

use super::columns::determinant;
use super::polynomial::Polynomial;
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::Ray;
use crate::per_axis::per_axis;
use std::cmp::Ordering::{Equal, Greater, Less};

/// Rule E11. With the edges e1 and e2 at p00 and f = p11 - p10 - p01 + p00 as axes, the surface is
/// w = u v: the ray meets it at the roots of a polynomial in its parameter. If the corners are in
/// one plane, the rulings are found in that plane.
pub(super) fn meet(corners: [ExactVector; 4], ray: &Ray, number: usize) -> Option<Root> {
    let [p00, p10, p01, p11] = &corners;
    let (e1, e2) = (p10.minus(p00), p01.minus(p00));
    let f = p11.minus(p10).minus(&e2);
    let volume = determinant(&[e1.clone(), e2.clone(), f.clone()]);
    let start = ExactVector::from(ray.origin).minus(p00);
    let step = ExactVector::from(ray.direction);
    if volume.is_zero() {
        return meet_flat(&[e1, e2, f], &start, &step).filter(|_| number == 0);
    }
    // Coordinates in these axes times the volume, as in Cramer's rule.
    let coordinate = |of: &dyn Fn(&ExactVector) -> [ExactVector; 3]| {
        Polynomial::linear(determinant(&of(&start)), determinant(&of(&step)))
    };
    let u = coordinate(&|r| [r.clone(), e2.clone(), f.clone()]);
    let v = coordinate(&|r| [e1.clone(), r.clone(), f.clone()]);
    let w = coordinate(&|r| [e1.clone(), e2.clone(), r.clone()]);
    let one = Polynomial::constant(volume.clone());
    let equation = w.times(&one).minus(&u.times(&v));
    let mirrors = volume.sign() == Less;
    let is_within = |x: &Polynomial, t: &Root| {
        [x.clone(), one.minus(x)].iter().all(|side| {
            let sign = side.sign_at(t, &equation);
            sign != if mirrors { Greater } else { Less }
        })
    };
    let is_there = |t: &Root| t.sign() == Greater && is_within(&u, t) && is_within(&v, t);
    equation.roots().into_iter().filter(is_there).nth(number)
}

/// A patch in a plane. The ray crosses it at one point. Relative to p00 the ruling at u starts at
/// u e1 and runs along e2 + u f; in the plane, the point is on its line where a cross product is 0.
fn meet_flat(
    [e1, e2, f]: &[ExactVector; 3],
    start: &ExactVector,
    step: &ExactVector,
) -> Option<Root> {
    let normals = [e1.cross(e2), e1.cross(f), e2.cross(f)];
    let normal = normals.into_iter().find(|normal| !normal.is_zero())?;
    let slope = normal.dot(step);
    if slope.is_zero() {
        return None;
    }
    let height = -&normal.dot(start);
    // The point times the slope. So are all vectors below.
    let point = start.times(&slope).plus(&step.times(&height));
    let vector = |constant: &ExactVector, linear: &ExactVector| {
        per_axis(|k| Polynomial::linear(&constant[k] * &slope, &linear[k] * &slope))
    };
    let zero = ExactVector::from([0.0; 3]);
    let along = vector(e2, f);
    let from_start: [Polynomial; 3] = {
        let ruling = vector(&zero, e1);
        std::array::from_fn(|k| Polynomial::constant(point[k].clone()).minus(&ruling[k]))
    };
    // Any component of the normal that is not 0 will do.
    let axis = (0..3).find(|k| !normal[*k].is_zero())?;
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let equation = from_start[i]
        .times(&along[j])
        .minus(&from_start[j].times(&along[i]));
    let dot = |a: &[Polynomial; 3], b: &[Polynomial; 3]| {
        let product = |k: usize| a[k].times(&b[k]);
        product(0).plus(&product(1)).plus(&product(2))
    };
    let (share, whole) = (dot(&from_start, &along), dot(&along, &along));
    let is_there = |u: &Root| {
        let sign = |x: &Polynomial| x.sign_at(u, &equation);
        let is_in_u = u.sign() != Less && u.compare_with(&Dyadic::from(1.0)) != Greater;
        let has_length = sign(&whole) != Equal;
        is_in_u && has_length && sign(&share) != Less && sign(&whole.minus(&share)) != Less
    };
    let t = Root::ratio(height, slope.clone());
    (t.sign() == Greater && equation.roots().iter().any(is_there)).then_some(t)
}
