//! The curves of a scene: points along them, and the segments between these.

use super::Geometry;
use super::runs::{CapacityError, FirstNumber};
use crate::geometry::{Point, Vector};
use crate::shape::{PrimitiveId, Segment};

/// A point of a curve in object space, or the direction in which a curve begins or ends.
///
/// A curve is stored as its direction at the start, its points, and its direction at the end.
/// Neighbouring segments share a point, and are cut in one plane there: across the vector between
/// the points on both sides. So they leave no gap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    place: [f64; 3],
    /// NaN marks a direction.
    half_width: f64,
}

/// Where a segment is.
#[derive(Debug, Clone, Copy)]
pub(super) struct StoredSegment {
    /// The index of the point that it begins at.
    first_point: u32,
    pub(super) transform: u32,
}

/// The segments of one shape, with consecutive primitive numbers.
#[derive(Debug)]
pub(super) struct SegmentRun {
    pub(super) first_segment: u32,
    pub(super) first_number: FirstNumber,
    pub(super) shape: u32,
}

/// All curves of one [`Geometry`].
#[derive(Debug, Default)]
pub(super) struct Curves {
    pub(super) points: Vec<CurvePoint>,
    pub(super) segments: Vec<StoredSegment>,
    pub(super) runs: Vec<SegmentRun>,
}

impl StoredSegment {
    /// Its numbers.
    pub(super) fn words(&self) -> [u64; 1] {
        [u64::from(self.first_point) << 32 | u64::from(self.transform)]
    }
}

impl CurvePoint {
    /// A point, and half of the width of the curve there. A width that is not a number is taken for
    /// infinite: then its segments are never hit.
    pub fn at(point: Point, half_width: f64) -> CurvePoint {
        let half_width = if half_width.is_nan() {
            f64::INFINITY
        } else {
            half_width
        };
        CurvePoint {
            place: point.to_array(),
            half_width,
        }
    }

    /// The direction of a curve at its start or its end.
    pub fn direction(direction: Vector) -> CurvePoint {
        CurvePoint {
            place: direction.to_array(),
            half_width: f64::NAN,
        }
    }

    fn is_direction(&self) -> bool {
        self.half_width.is_nan()
    }

    /// The bits of its numbers.
    pub(super) fn bits(&self) -> [u64; 4] {
        let [x, y, z] = self.place.map(f64::to_bits);
        [x, y, z, self.half_width.to_bits()]
    }
}

impl Curves {
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.points[..])
            + size_of_val(&self.segments[..])
            + size_of_val(&self.runs[..])
    }

    /// The run of a segment.
    pub(super) fn run_of(&self, segment: u32) -> &SegmentRun {
        let next = self
            .runs
            .partition_point(|run| run.first_segment <= segment);
        &self.runs[next - 1]
    }

    /// Makes the segments of the shapes that `is_hidden` impossible to hit.
    pub(super) fn hide(&mut self, is_hidden: impl Fn(u32) -> bool) {
        if !self.runs.iter().any(|run| is_hidden(run.shape)) {
            return;
        }
        let nowhere = self.points.len() as u32;
        let dead = CurvePoint::at(Point::new(f64::NAN, f64::NAN, f64::NAN), 0.0);
        self.points
            .extend([CurvePoint::direction(Vector::default()), dead, dead]);
        let ends = self
            .runs
            .iter()
            .skip(1)
            .map(|run| run.first_segment as usize);
        let ends: Vec<usize> = ends.chain([self.segments.len()]).collect();
        for (run, end) in self.runs.iter().zip(ends) {
            if is_hidden(run.shape) {
                let segments = &mut self.segments[run.first_segment as usize..end];
                segments
                    .iter_mut()
                    .for_each(|segment| segment.first_point = nowhere + 1);
            }
        }
    }
}

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
    [0, 1, 2].map(|k| to.place[k] - from.place[k])
}
