//! The test of a segment in `f64`, with error bounds.

use super::Segment;
use crate::exact::Approximation;
use crate::geometry::Vector;
use crate::per_axis::per_axis;
use crate::shape::quadric::filter::{Approximations, ScaledSpace, cross, dot};
use crate::shape::{FilterRay, FilterResult};
use std::cmp::Ordering::{Greater, Less};

/// A ray and a segment in object space, times a positive factor and the sign of the determinant.
struct Meeting {
    /// From the origin of the ray to both ends.
    tips: [Approximations; 2],
    direction: Approximations,
    /// From one end to the other.
    axis: Approximations,
    /// The direction x the axis.
    across: Approximations,
    /// Half of the width at each end.
    widths: [Approximation; 2],
}

impl Segment {
    /// Whether and where `ray` hits it, as far as `f64` can tell: by the formulas of
    /// [`Segment::exact`], with a bound on the error of each number.
    pub fn filter(&self, ray: &FilterRay) -> FilterResult {
        let space = ScaledSpace::of(&self.world_from_object, 1.0, ray);
        let scaled = |number: f64| Approximation::exactly(number) * space.determinant;
        let [first, last] = self.ends;
        // From the numbers of the file, which are closer to each other than to the ray.
        let difference =
            |k: usize| Approximation::exactly(last[k]) - Approximation::exactly(first[k]);
        let axis = per_axis(|k| difference(k) * space.determinant);
        let meeting = Meeting {
            tips: self
                .ends
                .map(|end| per_axis(|k| scaled(end[k]) - space.origin[k])),
            direction: space.direction,
            axis,
            across: cross(&space.direction, &axis),
            widths: self.half_widths.map(|width| scaled(width).abs()),
        };
        let tangents = self.tangents.map(|tangent| {
            let cuts = tangent != Vector::default();
            cuts.then(|| per_axis(|k| scaled(tangent[k])))
        });
        meeting.hit(&tangents).unwrap_or(FilterResult::Unsure)
    }
}

impl Meeting {
    /// `None` where that is not sure.
    fn hit(&self, [at_start, at_end]: &[Option<Approximations>; 2]) -> Option<FilterResult> {
        let [first, last] = self.widths;
        let slant = dot(&self.across, &self.across);
        let square_of_distance = dot(&self.tips[0], &self.across).square();
        let beyond = square_of_distance - first.at_least(last).square() * slant;
        if beyond.sign() == Some(Greater) {
            return Some(FilterResult::Miss);
        }
        slant.sign()?;
        if self.is_before(0, at_start)? || self.is_behind(1, at_end)? {
            return Some(FilterResult::Miss);
        }
        let moment = cross(&self.tips[0], &self.direction);
        // w, times the square of c.
        let place = dot(&moment, &self.across);
        if place.sign()? == Less {
            return self.hit_tip(0);
        }
        if (place - slant).sign()? == Greater {
            return self.hit_tip(1);
        }
        let width = slant * first + place * (last - first);
        if (square_of_distance * slant - width.square()).sign()? == Greater {
            return Some(FilterResult::Miss);
        }
        ahead(dot(&cross(&self.tips[0], &self.axis), &self.across).over(slant))
    }

    /// Whether the ray passes before an end, along a tangent.
    fn is_before(&self, end: usize, tangent: &Option<Approximations>) -> Option<bool> {
        self.side(end, tangent)
            .map_or(Some(false), |side| side.sign().map(|side| side == Less))
    }

    /// Whether the ray passes behind an end, along a tangent.
    fn is_behind(&self, end: usize, tangent: &Option<Approximations>) -> Option<bool> {
        self.side(end, tangent)
            .map_or(Some(false), |side| side.sign().map(|side| side == Greater))
    }

    /// How far along a tangent the ray passes an end, times a positive factor.
    fn side(&self, end: usize, tangent: &Option<Approximations>) -> Option<Approximation> {
        let tangent = tangent.as_ref()?;
        let moment = cross(&self.tips[end], &self.direction);
        Some(dot(&moment, &cross(&self.direction, tangent)))
    }

    /// A hit where the ray comes nearest to an end, if it is near enough.
    fn hit_tip(&self, end: usize) -> Option<FilterResult> {
        let (tip, d) = (&self.tips[end], &self.direction);
        let (off, square) = (cross(tip, d), dot(d, d));
        let beyond = (dot(&off, &off) - self.widths[end].square() * square).sign()?;
        if beyond == Greater {
            return Some(FilterResult::Miss);
        }
        ahead(dot(tip, d).over(square))
    }
}

/// A hit at `t`, if that is positive.
fn ahead(t: Approximation) -> Option<FilterResult> {
    let bracket = t.bracket();
    match t.sign()? {
        Greater if bracket.low > 0.0 => Some(FilterResult::Hit(bracket)),
        Greater => None,
        _ => Some(FilterResult::Miss),
    }
}
