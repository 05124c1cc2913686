//! Single-precision test of a segment, without error bounds.

use super::Segment;
use crate::geometry::{Point, Vector};
use crate::per_axis::per_axis;
use crate::shape::quadric::scale_of;
use crate::shape::vector32::{cross, dot};

/// A segment with the numbers that the test uses: in object space, about the middle of its axis,
/// times the determinant of the matrix.
pub(crate) struct SingleSegment {
    /// The adjugate of the linear part over a number s.
    adjugate: [[f32; 3]; 3],
    /// From the middle to one end.
    half: [f32; 3],
    half_widths: [f32; 2],
    tangents: [[f32; 3]; 2],
}

impl SingleSegment {
    /// `segment`, one unit of which is `units` of the ray's.
    pub(crate) fn new(segment: &Segment, units: f64) -> SingleSegment {
        let scale = scale_of(&segment.world_from_object);
        let m = &segment.world_from_object;
        let [x, y, z] = per_axis(|j| Vector::from(m.column(j).map(|entry| entry / scale)));
        let rows = [y.cross(z), z.cross(x), x.cross(y)];
        let determinant = x.dot(rows[0]);
        let factor = determinant * (scale * units);
        let [a, b] = segment.ends;
        let scaled = |number: f64| (number * factor) as f32;
        // Only the direction of a tangent counts, and its sign.
        let tangent = |v: Vector| {
            let largest = v.largest().max(f64::MIN_POSITIVE) * determinant.signum();
            v.to_array().map(|component| (component / largest) as f32)
        };
        SingleSegment {
            adjugate: rows.map(|row| row.to_array().map(|entry| entry as f32)),
            half: per_axis(|k| scaled(0.5 * b[k] - 0.5 * a[k])),
            half_widths: segment.half_widths.map(scaled),
            tangents: segment.tangents.map(tangent),
        }
    }

    /// The middle of the axis in the world, which rays are relative to.
    pub(crate) fn middle(segment: &Segment) -> Point {
        segment.placed_axis().middle.into()
    }

    /// The `t` at which a ray hits the segment; `origin` is relative to its middle.
    pub(crate) fn intersect(&self, origin: [f32; 3], direction: [f32; 3]) -> Option<f32> {
        let apply = |v: [f32; 3]| self.adjugate.map(|row| dot(row, v));
        let (o, d) = (apply(origin), apply(direction));
        let half = self.half;
        let tips: [[f32; 3]; 2] =
            [-1.0, 1.0].map(|side| std::array::from_fn(|k| side * half[k] - o[k]));
        let axis = half.map(|component| 2.0 * component);
        let across = cross(d, axis);
        let slant = dot(across, across);
        let side = |end: usize| dot(cross(tips[end], d), cross(d, self.tangents[end]));
        let is_cut = side(0) < 0.0 || side(1) > 0.0;
        if is_cut || slant.is_nan() || slant <= 0.0 {
            return None;
        }
        let w = dot(cross(tips[0], d), across) / slant;
        let width =
            self.half_widths[0] + w.clamp(0.0, 1.0) * (self.half_widths[1] - self.half_widths[0]);
        let tip = |end: usize| {
            let off = cross(tips[end], d);
            (dot(off, off) / dot(d, d), dot(tips[end], d) / dot(d, d))
        };
        let (square_of_distance, t) = if w <= 0.0 {
            tip(0)
        } else if w >= 1.0 {
            tip(1)
        } else {
            let distance = dot(tips[0], across);
            let t = dot(cross(tips[0], axis), across) / slant;
            (distance * distance / slant, t)
        };
        (t > 0.0 && square_of_distance <= width * width).then_some(t)
    }
}
