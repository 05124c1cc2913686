//! Segments of curves: strips along straight lines that face every ray.

mod bounds;
mod exact;
mod filter;
mod single;
mod surface;
#[cfg(test)]
mod tests;

pub(crate) use bounds::PlacedAxis;
pub(crate) use single::SingleSegment;

use crate::geometry::{Matrix, Point, Vector};
use crate::per_axis::per_axis;

/// A strip between two points of a curve (rule E12).
///
/// It has no orientation: across its axis, it is perpendicular in object space to whatever ray
/// looks at it. So it is hit where a ray comes near enough to the axis, at the point of the ray that
/// is nearest to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Places and stretches it.
    pub world_from_object: Matrix,
    /// Both ends of the axis, in object space.
    pub ends: [Point; 2],
    /// Half of the width at each end, not negative, in object space.
    pub half_widths: [f64; 2],
    /// The directions of the curve at the ends: the strip is cut across them. A vector of zeros
    /// cuts nothing.
    pub tangents: [Vector; 2],
}

impl Segment {
    /// Whether any ray can hit it (rule E12).
    pub fn can_be_hit(&self) -> bool {
        self.extent().is_some()
            && self.world_from_object.is_finite()
            && !self.world_from_object.is_singular()
    }

    /// The largest absolute coordinates in object space of the points where it may be hit; `None`
    /// where no ray can hit it, whatever its transform.
    pub fn extent(&self) -> Option<[f64; 3]> {
        let [a, b] = self.ends;
        let widest = self.widest();
        let are_finite = |vectors: &[Vector; 2]| {
            vectors
                .iter()
                .all(|v| v.to_array().iter().all(|x| x.is_finite()))
        };
        let is_there = a.is_finite()
            && b.is_finite()
            && a != b
            && widest > 0.0
            && widest.is_finite()
            && are_finite(&self.tangents);
        is_there.then(|| per_axis(|k| (a[k].abs().max(b[k].abs()) + widest).next_up()))
    }

    /// The larger one of the half widths; NaN if one of them is.
    pub(crate) fn widest(&self) -> f64 {
        let [a, b] = self.half_widths;
        if b > a || b.is_nan() { b } else { a }
    }
}
