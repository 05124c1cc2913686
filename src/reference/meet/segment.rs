//! Exact intersection of a ray with a segment of a curve (rule E12).

use super::columns::{columns, determinant};
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::{Matrix, Ray};
use crate::per_axis::per_axis;
use crate::shape::Segment;
use std::cmp::Ordering::{Equal, Greater, Less};

/// A ray in object space, times the determinant of the matrix, by Cramer's rule.
struct ObjectRay {
    origin: ExactVector,
    direction: ExactVector,
    determinant: Dyadic,
}

/// Rule E12 by the point of the axis that is nearest to the ray, as a fraction: all numbers of the
/// point, of the distance and of t are multiplied by its denominator.
pub(super) fn meet(segment: &Segment, ray: &Ray) -> Option<Root> {
    if !is_there(segment) {
        return None;
    }
    let space = ObjectRay::new(&segment.world_from_object, ray)?;
    let d = &space.direction;
    let scaled = |v: [f64; 3]| ExactVector::from(v).times(&space.determinant);
    let [a, b] = segment
        .ends
        .map(|end| scaled(end.to_array()).minus(&space.origin));
    let e = b.minus(&a);
    let (dd, de, ee) = (d.dot(d), d.dot(&e), e.dot(&e));
    let denominator = &(&ee * &dd) - &de.square();
    if denominator.sign() != Greater {
        return None;
    }
    // Where the ray passes an end along a vector, both seen along the ray.
    let along = |tip: &ExactVector, v: &ExactVector| {
        (&(&tip.dot(d) * &d.dot(v)) - &(&tip.dot(v) * &dd)).sign()
    };
    let [first, last] = segment.tangents.map(|v| scaled(v.to_array()));
    if along(&a, &first) == Less || along(&b, &last) == Greater {
        return None;
    }
    let numerator = &(&a.dot(d) * &de) - &(&a.dot(&e) * &dd);
    let numerator = match (numerator.sign(), numerator.cmp(&denominator)) {
        (Less | Equal, _) => Dyadic::zero(),
        (Greater, Greater) => denominator.clone(),
        _ => numerator,
    };
    let nearest = a.times(&denominator).plus(&e.times(&numerator));
    let [first, last] = segment
        .half_widths
        .map(|width| &Dyadic::from(width) * &space.determinant);
    let width = &(&first * &denominator) + &(&(&last - &first) * &numerator);
    let to_nearest = nearest.dot(d);
    let off = &(&nearest.dot(&nearest) * &dd) - &to_nearest.square();
    let is_hit = off <= &width.square() * &dd && to_nearest.sign() == Greater;
    is_hit.then(|| Root::ratio(to_nearest, &denominator * &dd))
}

/// Whether all numbers are finite, and the segment has a width.
fn is_there(segment: &Segment) -> bool {
    let ends = segment.ends.iter().flat_map(|end| end.to_array());
    let tangents = segment.tangents.iter().flat_map(|v| v.to_array());
    let mut numbers = ends.chain(tangents).chain(segment.half_widths);
    segment.world_from_object.is_finite()
        && numbers.all(f64::is_finite)
        && segment.half_widths != [0.0; 2]
}

impl ObjectRay {
    /// `None` under a singular matrix.
    fn new(m: &Matrix, ray: &Ray) -> Option<ObjectRay> {
        let columns = columns(m);
        let below = determinant(&columns);
        let coordinates = |v: &ExactVector| {
            ExactVector::new(per_axis(|k| {
                let mut replaced = columns.clone();
                replaced[k] = v.clone();
                determinant(&replaced)
            }))
        };
        let from_centre = ExactVector::from(ray.origin).minus(&ExactVector::from(m.column(3)));
        (!below.is_zero()).then(|| ObjectRay {
            origin: coordinates(&from_centre),
            direction: coordinates(&ExactVector::from(ray.direction)),
            determinant: below.clone(),
        })
    }
}
