//! Projects points onto the film.

use crate::accel::space::{larger, smaller};
use crate::accel::view::{CameraView, ROUNDING, UNDERFLOW};
use crate::geometry::Point;
use crate::parallel::CollectVec;
use crate::simd::{LANES, Lanes, Level, SimdKernel};
use rayon::prelude::*;

/// Bounds the error of a projected point, in pixels, before it is rounded to `f32`.
pub(super) const MAX_PIXEL_ERROR: f64 = 1.0 / (1 << 14) as f64;
/// A depth is clear of the eye's plane if it exceeds its error by this factor.
const CLEAR: f64 = 1e3;

/// A point on the film: column, row, nearness, and [`FilmPoint::FRONT`], `BEHIND` or `UNKNOWN`.
///
/// In a perspective, a point behind the eye has the column and row at which the line through the
/// eye meets the film.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub(super) struct FilmPoint(pub(super) [f32; 4]);

impl FilmPoint {
    /// In front of the eye.
    pub(super) const FRONT: f32 = 0.0;
    /// Behind the eye: no ray gets there.
    pub(super) const BEHIND: f32 = 1.0;
    /// So close to the eye's plane, or so far, that its place is unknown: column and row are NaN.
    /// The sum of three sides tells whether any is unknown, or all are behind.
    pub(super) const UNKNOWN: f32 = 4.0;

    /// The smaller number in each place.
    #[inline(always)]
    pub(super) fn min(self, other: FilmPoint) -> FilmPoint {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        FilmPoint([smaller(a, e), smaller(b, f), smaller(c, g), smaller(d, h)])
    }

    /// The larger number in each place.
    #[inline(always)]
    pub(super) fn max(self, other: FilmPoint) -> FilmPoint {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        FilmPoint([larger(a, e), larger(b, f), larger(c, g), larger(d, h)])
    }
}

/// A view, with the terms of its error bounds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Projector<'a> {
    view: &'a CameraView,
    /// Bounds the error of each component in film space, relative to the largest coordinate.
    errors: [f64; 3],
    /// For an orthographic camera, what nearness is raised by, relative to the largest coordinate.
    /// It exceeds the tolerance of the rasterizer's bounds.
    raise: f64,
}

impl<'a> Projector<'a> {
    pub(super) fn new(view: &'a CameraView) -> Projector<'a> {
        let sums = view
            .film_from_world
            .map(|row| row[0].abs() + row[1].abs() + row[2].abs());
        Projector {
            view,
            errors: sums.map(|sum| sum * ROUNDING),
            raise: sums[2] / f64::from(1 << 16),
        }
    }

    /// Projects points that stand side by side.
    #[inline(always)]
    pub(super) fn project<const N: usize>(&self, points: &[[f64; N]; 3]) -> [FilmPoint; N] {
        let CameraView {
            is_perspective,
            eye,
            film_from_world: rows,
            offset,
            ..
        } = self.view;
        let mut lanes = [[0.0f32; N]; 4];
        for k in 0..N {
            let [x, y, z] = [
                points[0][k] - eye[0],
                points[1][k] - eye[1],
                points[2][k] - eye[2],
            ];
            let largest = x.abs().max(y.abs()).max(z.abs());
            let along = |row: &[f64; 3]| row[0] * x + row[1] * y + row[2] * z;
            let [across, down, depth] = [along(&rows[0]), along(&rows[1]), along(&rows[2])];
            let error = |error: f64| largest * error + f64::from(UNDERFLOW);
            let [a, b, c] = self.errors;
            let errors = [error(a), error(b), error(c)];
            let inverse = if *is_perspective { 1.0 / depth } else { 1.0 };
            let column = across * inverse + offset[0];
            let row = down * inverse + offset[1];
            // The error of depth moves a pixel in proportion to its distance from the first one.
            let error = |pixel: f64, error: f64, offset: f64| {
                (error + pixel.abs() * errors[2]) * inverse.abs() + offset.abs() * ROUNDING
            };
            let is_clear = !is_perspective | (depth.abs() > errors[2] * CLEAR);
            // A comparison with NaN fails.
            let is_known = is_clear
                & (error(column, errors[0], offset[0]) < MAX_PIXEL_ERROR)
                & (error(row, errors[1], offset[1]) < MAX_PIXEL_ERROR);
            let is_behind = depth + errors[2] < 0.0;
            let nearness = if *is_perspective {
                inverse
            } else {
                largest * self.raise - depth
            };
            lanes[0][k] = if is_known { column as f32 } else { f32::NAN };
            lanes[1][k] = if is_known { row as f32 } else { f32::NAN };
            lanes[2][k] = nearness as f32;
            let side = if is_behind {
                FilmPoint::BEHIND
            } else {
                FilmPoint::FRONT
            };
            lanes[3][k] = if is_known { side } else { FilmPoint::UNKNOWN };
        }
        // A loop, since closures are not always inlined into the kernel.
        let mut points = [FilmPoint([0.0; 4]); N];
        for (k, point) in points.iter_mut().enumerate() {
            point.0 = [lanes[0][k], lanes[1][k], lanes[2][k], lanes[3][k]];
        }
        points
    }
}

/// Projects all of `vertices`, on all threads.
pub(super) fn project_all(
    vertices: &[Point],
    projector: &Projector,
    level: Level,
) -> Vec<FilmPoint> {
    let groups = vertices.par_chunks(LANES).with_min_len(1 << 8);
    let project = |vertices| {
        level.run(ProjectGroup {
            projector,
            vertices,
        })
    };
    groups.map(project).collect_vec().into_flattened()
}

/// Projects up to sixteen vertices.
struct ProjectGroup<'a> {
    projector: &'a Projector<'a>,
    vertices: &'a [Point],
}

impl SimdKernel for ProjectGroup<'_> {
    type Output = [FilmPoint; LANES];

    #[inline(always)]
    fn run<S: Lanes>(self, _: S) -> [FilmPoint; LANES] {
        let mut points = [[0.0; LANES]; 3];
        for (k, point) in self.vertices.iter().enumerate() {
            (points[0][k], points[1][k], points[2][k]) = (point.x, point.y, point.z);
        }
        self.projector.project(&points)
    }
}
