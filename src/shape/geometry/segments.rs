//! The segments of curves in a geometry.

use super::Geometry;
use super::curves::{CurvePoint, SegmentRun, StoredSegment};
use super::runs::CapacityError;
use crate::per_axis::per_axis;
use crate::shape::{PrimitiveId, Segment};

impl Geometry {
    /// Appends the segments of a shape's curves: each has a direction, two or more points, and
    /// another direction. `transform` is a number from [`Geometry::add_transform`].
    pub fn add_curves(
        &mut self,
        mut points: Vec<CurvePoint>,
        transform: u32,
        shape: u32,
    ) -> Result<(), CapacityError> {
        let is_start = |pair: &[CurvePoint]| !pair[0].is_direction() && !pair[1].is_direction();
        let count = points.windows(2).filter(|pair| is_start(pair)).count();
        let limit = PrimitiveId::MOST_CURVED as u64;
        let what = "segments of curves";
        let all = self.curves.segments.len() + count;
        let all_points = self.curves.points.len() + points.len();
        if all as u64 > limit || all_points as u64 > u64::from(u32::MAX) {
            return Err(CapacityError { what, limit });
        }
        let first_number = self.next_number(count)?;
        if count == 0 {
            return Ok(());
        }
        let curves = &mut self.curves;
        curves.runs.push(SegmentRun {
            first_segment: curves.segments.len() as u32,
            first_number,
            shape,
        });
        let base = curves.points.len();
        let starts = (0..points.len() - 1).filter(|k| is_start(&points[*k..]));
        curves.segments.extend(starts.map(|k| StoredSegment {
            first_point: (base + k) as u32,
            transform,
        }));
        if curves.points.is_empty() {
            curves.points = points;
        } else {
            curves.points.append(&mut points);
        }
        Ok(())
    }

    /// The number of segments of curves in no instance, including those that can never be hit.
    pub fn segment_count(&self) -> usize {
        self.curves.segments.len()
    }

    /// Segment `index`.
    pub fn segment(&self, index: usize) -> Segment {
        let StoredSegment {
            first_point,
            transform,
        } = self.curves.segments[index];
        let points = &self.curves.points;
        let first = first_point as usize;
        let [from, to] = [&points[first], &points[first + 1]];
        let (before, after) = (&points[first - 1], points.get(first + 2));
        let at_start = match before {
            direction if direction.is_direction() => direction.place,
            point => difference(point, to),
        };
        let at_end = match after {
            Some(direction) if direction.is_direction() => direction.place,
            Some(point) => difference(from, point),
            None => [0.0; 3],
        };
        Segment {
            world_from_object: *self.transform(transform),
            ends: [from.place.into(), to.place.into()],
            half_widths: [from.half_width, to.half_width],
            tangents: [at_start.into(), at_end.into()],
        }
    }

    /// The point of the curve at which segment `index` begins.
    #[inline]
    pub(crate) fn start_of_segment(&self, index: usize) -> &CurvePoint {
        &self.curves.points[self.curves.segments[index].first_point as usize]
    }
}

/// From one point to another, each component rounded once.
fn difference(from: &CurvePoint, to: &CurvePoint) -> [f64; 3] {
    per_axis(|k| to.place[k] - from.place[k])
}
