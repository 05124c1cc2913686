//! Boxes around segments, and their axes in the world.

use super::Segment;
use crate::geometry::{Bounds, Point};
use crate::per_axis::per_axis;

/// Exceeds all roundings of a coordinate, relative to its absolute terms: eight units of 2^-53.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Exceeds what products lose where they underflow.
const LOST: f64 = f64::MIN_POSITIVE;

/// The axis of a segment in the world, approximately.
pub(crate) struct PlacedAxis {
    /// The middle of the axis.
    pub(crate) middle: [f64; 3],
    /// From the middle to one end.
    pub(crate) half: [f64; 3],
    /// The absolute terms of the sums that make the middle.
    pub(crate) terms: [f64; 3],
}

impl Segment {
    /// A box that holds every point where a ray hits it.
    ///
    /// In object space such a point is no farther than half the width there from a point of the
    /// axis. So it lies in the hull of two balls, around both ends.
    pub fn bounds(&self) -> Bounds {
        let ranges = self
            .world_from_object
            .rows
            .each_ref()
            .map(|row| self.range_along(row));
        let corner = |end: usize| Point::new(ranges[0][end], ranges[1][end], ranges[2][end]);
        Bounds {
            low: corner(0),
            high: corner(1),
        }
    }

    /// The range of a coordinate, given its row of the matrix.
    ///
    /// Along it a ball reaches as far as its radius times the length of the row. A coordinate passes
    /// through six roundings, the length through four, and the slack itself through few more.
    fn range_along(&self, row: &[f64; 4]) -> [f64; 2] {
        let length = length(row);
        let [[a, b], [c, d]] = [0, 1].map(|end| {
            let p = self.ends[end];
            let terms = [row[0] * p.x, row[1] * p.y, row[2] * p.z, row[3]];
            let middle = ((terms[0] + terms[1]) + terms[2]) + terms[3];
            let [x, y, z, offset] = terms.map(f64::abs);
            let radius = length * self.half_widths[end];
            let reach = radius + ((((x + y) + z) + offset) + radius) * ROUNDING + LOST;
            [middle - reach, middle + reach]
        });
        [a.min(c).next_down(), b.max(d).next_up()]
    }

    /// The axis in the world.
    pub(crate) fn placed_axis(&self) -> PlacedAxis {
        let rows = &self.world_from_object.rows;
        let [a, b] = self.ends;
        let middle = per_axis(|k| 0.5 * a[k] + 0.5 * b[k]);
        let half = per_axis(|k| 0.5 * b[k] - 0.5 * a[k]);
        let along = |row: &[f64; 4], v: &[f64; 3]| row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
        let size = |row: &[f64; 4]| {
            let term = |k: usize| row[k].abs() * a[k].abs().max(b[k].abs());
            term(0) + term(1) + term(2) + row[3].abs()
        };
        PlacedAxis {
            middle: rows.each_ref().map(|row| along(row, &middle) + row[3]),
            half: rows.each_ref().map(|row| along(row, &half)),
            terms: rows.each_ref().map(size),
        }
    }
}

/// The length of the linear part of a row; the sum of its absolute entries, which is larger, where
/// squares would leave the range.
fn length([x, y, z, _]: &[f64; 4]) -> f64 {
    let sum = x.abs() + y.abs() + z.abs();
    if sum > 1e-140 && sum < 1e150 {
        (x * x + y * y + z * z).sqrt()
    } else {
        sum
    }
}
