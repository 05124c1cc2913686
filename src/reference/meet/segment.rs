//! Exact intersection of a ray with a segment of a curve (rule E12).

use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::Ray;
use crate::shape::Segment;
use std::cmp::Ordering::{Equal, Greater, Less};

/// Rule E12 by the point of the axis that is nearest to the ray, as a fraction: all numbers of the
/// point, of the distance and of t are multiplied by its denominator.
///
/// Object space is taken times the determinant of the matrix, by Cramer's rule.
pub(super) fn meet(segment: &Segment, ray: &Ray) -> Option<Root> {
    let m = &segment.world_from_object;
    let [widest, narrowest] = segment.half_widths;
    let numbers = segment.ends.iter().flat_map(|end| end.to_array());
    let tangents = segment.tangents.iter().flat_map(|v| v.to_array());
    let mut all = numbers.chain(tangents).chain([widest, narrowest]);
    if !m.is_finite() || !all.all(f64::is_finite) || (widest == 0.0 && narrowest == 0.0) {
        return None;
    }
    let columns = [0, 1, 2].map(|j| ExactVector::from(m.column(j)));
    let determinant = |[x, y, z]: &[ExactVector; 3]| x.dot(&y.cross(z));
    let below = determinant(&columns);
    if below.is_zero() {
        return None;
    }
    let in_object = |v: &ExactVector| {
        ExactVector::new([0, 1, 2].map(|k| {
            let mut replaced = columns.clone();
            replaced[k] = v.clone();
            determinant(&replaced)
        }))
    };
    let origin = ExactVector::from(ray.origin).minus(&ExactVector::from(m.column(3)));
    let (origin, d) = (
        in_object(&origin),
        in_object(&ExactVector::from(ray.direction)),
    );
    let scaled = |v: [f64; 3]| ExactVector::from(v).times(&below);
    let [a, b] = segment
        .ends
        .map(|end| scaled(end.to_array()).minus(&origin));
    let e = b.minus(&a);
    let (dd, de, ee) = (d.dot(&d), d.dot(&e), e.dot(&e));
    let denominator = &(&ee * &dd) - &de.square();
    if denominator.sign() != Greater {
        return None;
    }
    // Where the ray passes an end along a vector, both seen along the ray.
    let along = |tip: &ExactVector, v: &ExactVector| {
        let from_tip = &(&tip.dot(&d) * &d.dot(v)) - &(&tip.dot(v) * &dd);
        from_tip.sign()
    };
    let [first, last] = segment.tangents.map(|v| scaled(v.to_array()));
    if along(&a, &first) == Less || along(&b, &last) == Greater {
        return None;
    }
    let numerator = &(&a.dot(&d) * &de) - &(&a.dot(&e) * &dd);
    let numerator = match (numerator.sign(), numerator.cmp(&denominator)) {
        (Less | Equal, _) => Dyadic::zero(),
        (Greater, Greater) => denominator.clone(),
        _ => numerator,
    };
    let nearest = a.times(&denominator).plus(&e.times(&numerator));
    let [first, last] = segment
        .half_widths
        .map(|width| &Dyadic::from(width) * &below);
    let width = &(&first * &denominator) + &(&(&last - &first) * &numerator);
    let to_nearest = nearest.dot(&d);
    let off = &(&nearest.dot(&nearest) * &dd) - &to_nearest.square();
    if off > &width.square() * &dd || to_nearest.sign() != Greater {
        return None;
    }
    Some(Root::ratio(to_nearest, &denominator * &dd))
}
