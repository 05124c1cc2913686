//! The curves of a scene: points along them, and the places of the segments between these.

use super::runs::FirstNumber;
use crate::geometry::{Point, Vector};

/// A point of a curve in object space, or the direction in which a curve begins or ends.
///
/// A curve is stored as its direction at the start, its points, and its direction at the end.
/// Neighbouring segments share a point, and are cut in one plane there: across the vector between
/// the points on both sides. So they leave no gap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    pub(super) place: [f64; 3],
    /// NaN marks a direction.
    pub(super) half_width: f64,
}

/// Where a segment is.
#[derive(Debug, Clone, Copy)]
pub(super) struct StoredSegment {
    /// The index of the point that it begins at.
    pub(super) first_point: u32,
    pub(super) transform: u32,
}

/// The segments of one shape, with consecutive primitive numbers.
#[derive(Debug)]
pub(super) struct SegmentRun {
    pub(super) first_segment: u32,
    pub(super) first_number: FirstNumber,
    pub(super) shape: u32,
}

/// All curves of one [`Geometry`](super::Geometry).
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

    pub(super) fn is_direction(&self) -> bool {
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
