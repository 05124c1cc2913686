//! The object space of a segment as a tile sees it: vectors of rays and of the axis, with bounds.

use crate::accel::view::{TILE, TileFrame};
use crate::exact::{exponent_of, power_of_two};
use crate::geometry::{Matrix, Vector};
use crate::per_axis::per_axis;
use crate::shape::Segment;

/// Exceeds the roundings of a sum of few products, relative to the absolute terms.
const ROUNDING: f64 = 1.0 / (1u64 << 48) as f64;

/// From world space to object space times the determinant, and times a power of two.
struct ToObject {
    rows: [[f64; 3]; 3],
    /// The sums of the absolute terms of the rows.
    terms: [[f64; 3]; 3],
    /// What points in the numbers of the file are multiplied by.
    of_file: f64,
    /// The relative error of that.
    error: f64,
}

/// A segment and the rays of a tile.
pub(super) struct SegmentSpace {
    /// From the eye to the ends of the axis.
    pub(super) tips: [[f64; 3]; 2],
    pub(super) axis: [f64; 3],
    pub(super) tangents: [[f64; 3]; 2],
    pub(super) half_widths: [f64; 2],
    /// The direction of the tile's first pixel, and what a column and a row add to it.
    pub(super) directions: [[f64; 3]; 3],
    /// Bounds the length of any direction.
    pub(super) direction_size: f64,
    /// Eight times the sum of the errors of directions, tips, axis and determinant, each relative to
    /// the sum of its absolute components, or to its bound, and what roundings add.
    pub(super) relative: f64,
}

impl ToObject {
    /// `unit` is about 1 in object space.
    fn of(m: &Matrix, unit: f64) -> ToObject {
        let [[scale, ..], ..] = m.rows;
        let is_scale = |i: usize| (0..3).all(|j| m.rows[i][j] == if i == j { scale } else { 0.0 });
        if (0..3).all(is_scale) {
            let one = power_of_two_for(unit * scale.abs());
            let unit_rows = per_axis(|i| per_axis(|j| if i == j { one } else { 0.0 }));
            return ToObject {
                rows: unit_rows,
                terms: unit_rows,
                of_file: scale * one,
                error: ROUNDING,
            };
        }
        let [x, y, z] = per_axis(|j| Vector::from(m.column(j)));
        let rows = [y.cross(z), z.cross(x), x.cross(y)];
        let terms = [
            y.absolute_cross(z),
            z.absolute_cross(x),
            x.absolute_cross(y),
        ];
        let determinant = x.dot(rows[0]);
        let one = power_of_two_for(unit * determinant.abs());
        let times = |v: Vector| v.to_array().map(|component| component * one);
        ToObject {
            rows: rows.map(times),
            terms: terms.map(times),
            of_file: determinant * one,
            error: ROUNDING * (1.0 + x.absolute().dot(terms[0]) / determinant.abs()),
        }
    }

    fn apply(&self, v: [f64; 3]) -> [f64; 3] {
        self.rows.map(|row| dot(&row, &v))
    }

    /// Bounds the sum of the absolute components of what has components up to `size`.
    fn size(&self, size: [f64; 3]) -> f64 {
        self.terms.iter().map(|terms| dot(terms, &size)).sum()
    }
}

impl SegmentSpace {
    /// `None` if numbers are too large, too small or too uncertain. Only for a perspective.
    pub(super) fn of(segment: &Segment, frame: &TileFrame) -> Option<SegmentSpace> {
        let m = &segment.world_from_object;
        let to_object = ToObject::of(m, segment.widest());
        let eye = frame.eye();
        let from_centre = per_axis(|k| eye[k] - m.rows[k][3]);
        let origin = to_object.apply(from_centre);
        let scaled = |v: [f64; 3]| v.map(|component| component * to_object.of_file);
        let [a, b] = segment.ends.map(|end| scaled(end.to_array()));
        let tips = [a, b].map(|end| per_axis(|k| end[k] - origin[k]));
        let [first, last] = segment.ends;
        let axis = scaled(per_axis(|k| last[k] - first[k]));
        let last_pixel = f64::from(TILE - 1);
        let [start, per_column, per_row] = frame.world_from_tile;
        let farthest =
            per_axis(|k| start[k].abs() + last_pixel * (per_column[k].abs() + per_row[k].abs()));
        let direction_size = to_object.size(farthest);
        let off = frame.view.ray_rounding.map(f64::from);
        let of_direction = to_object.size(off) / direction_size;
        let of_tips = |k: usize| {
            let end = [a, b][k];
            let terms = to_object.size(from_centre.map(f64::abs)) * ROUNDING;
            (terms + size(&end) * to_object.error) / size(&tips[k])
        };
        let errors = of_direction + of_tips(0).max(of_tips(1)) + to_object.error;
        let space = SegmentSpace {
            tips,
            axis,
            tangents: segment.tangents.map(|tangent| scaled(tangent.to_array())),
            half_widths: segment
                .half_widths
                .map(|width| width * to_object.of_file.abs()),
            directions: frame.world_from_tile.map(|v| to_object.apply(v)),
            direction_size,
            relative: 8.0 * errors + 16.0 * ROUNDING,
        };
        space.fits().then_some(space)
    }

    /// Tests whether products of the numbers stay in the range of `f32`, and errors are small.
    fn fits(&self) -> bool {
        let is_usual = |number: f64| number > 1e-12 && number < 1e15;
        let tips = self.tips.iter().all(|tip| is_usual(size(tip)));
        tips && is_usual(size(&self.axis))
            && is_usual(self.direction_size)
            && self.relative < 1.0 / (1 << 28) as f64
    }
}

/// The sum of the absolute components.
pub(super) fn size([x, y, z]: &[f64; 3]) -> f64 {
    x.abs() + y.abs() + z.abs()
}

pub(super) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A power of two that brings a number close to 1, or 0 if it is out of any usual range.
fn power_of_two_for(number: f64) -> f64 {
    if number > 1e-200 && number < 1e200 {
        power_of_two(-exponent_of(number))
    } else {
        0.0
    }
}
