//! The test of a segment in exact arithmetic.

use super::Segment;
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::Ray;
use crate::shape::quadric::exact::ScaledSpace;
use std::cmp::Ordering::{Greater, Less};

/// A ray and a segment in object space, times the determinant of the matrix.
struct Meeting {
    /// From the origin of the ray to both ends.
    tips: [ExactVector; 2],
    direction: ExactVector,
    /// Half of the width at each end, all with the sign of the determinant.
    widths: [Dyadic; 2],
}

impl Segment {
    /// The `t` at which `ray` hits it, if it does (rule E12). It [can be
    /// hit](Segment::can_be_hit), and the ray is finite and has a direction.
    ///
    /// With a and b from the origin of the ray to the ends, e = b - a, d the direction and
    /// c = d x e, the ray is nearest to the line of the axis at a + w e with w = (a x d) . c / |c|^2,
    /// and at t = (a x e) . c / |c|^2. Their distance is |a . c| / |c|.
    pub fn exact(&self, ray: &Ray) -> Option<Root> {
        let space = ScaledSpace::of(&self.world_from_object, ray);
        let scaled = |v: [f64; 3]| ExactVector::from(v).times(&space.determinant);
        let tips = self
            .ends
            .map(|end| scaled(end.to_array()).minus(&space.origin));
        let tangents = self.tangents.map(|tangent| scaled(tangent.to_array()));
        let widths = self
            .half_widths
            .map(|width| &Dyadic::from(width) * &space.determinant);
        let meeting = Meeting {
            tips,
            direction: space.direction,
            widths,
        };
        let t = meeting.hit(&tangents)?;
        (t.sign() == Greater).then_some(t)
    }
}

impl Meeting {
    /// Where the line of the ray hits the segment.
    fn hit(&self, [at_start, at_end]: &[ExactVector; 2]) -> Option<Root> {
        let [a, b] = &self.tips;
        let (d, axis) = (&self.direction, b.minus(a));
        let across = d.cross(&axis);
        let slant = across.dot(&across);
        let moment = a.cross(d);
        let is_cut = moment.dot(&d.cross(at_start)).sign() == Less
            || b.cross(d).dot(&d.cross(at_end)).sign() == Greater;
        if slant.is_zero() || is_cut {
            return None;
        }
        // w, times the square of c.
        let place = moment.dot(&across);
        if place.sign() != Greater {
            return self.hit_tip(0);
        }
        if place >= slant {
            return self.hit_tip(1);
        }
        let [first, last] = &self.widths;
        let width = &(&slant * first) + &(&place * &(last - first));
        let distance = a.dot(&across);
        let is_beside = &distance.square() * &slant > width.square();
        (!is_beside).then(|| Root::ratio(a.cross(&axis).dot(&across), slant))
    }

    /// Where the line of the ray comes nearest to an end, if it is near enough.
    fn hit_tip(&self, end: usize) -> Option<Root> {
        let (tip, d) = (&self.tips[end], &self.direction);
        let (off, square) = (tip.cross(d), d.dot(d));
        let is_beside = off.dot(&off) > &self.widths[end].square() * &square;
        (!is_beside).then(|| Root::ratio(tip.dot(d), square))
    }
}
