//! Reference hits of many pixels: halves the film until a part has one of them, and drops the
//! primitives that a part cannot see (Warnock, "A hidden surface algorithm for computer generated
//! halftone pictures", 1969).

use super::beam::Beam;
use super::{ReferenceHit, closest_hit_among};
use crate::camera::Camera;
use crate::exact::Bracket;
use crate::film::PixelBounds;
use crate::geometry::{Bounds, Point};
use crate::progress::Progress;
use crate::shape::{Form, Geometry, InstancedId, Primitive, Quadric, Revolved, Segment};
use rayon::prelude::*;

/// The largest number of primitives in a scene, with those of an object once for each instance. The
/// list of all takes 8 bytes for each.
pub const MAX_PRIMITIVES: u64 = 1 << 25;

/// All threads share longer lists.
const SHORT: usize = 1 << 14;

/// The hit of each of some pixels, in their order: the results of [`super::closest_hit`], as the
/// camera sees them, but faster. `progress` counts pixels.
///
/// It uses no aggregate. It drops a primitive for a pixel only if interval arithmetic shows that
/// all rays of a rectangle around the pixel miss the box around the primitive.
///
/// # Panics
/// If there are more than [`MAX_PRIMITIVES`].
pub fn answers(
    camera: &Camera,
    geometry: &Geometry,
    pixels: &[[u32; 2]],
    progress: Progress,
) -> Vec<Option<ReferenceHit>> {
    by_area(camera, geometry, pixels, |[x, y], primitives| {
        progress.advance(1);
        let hit = closest_hit_among(primitives.iter().copied(), geometry, &camera.ray(x, y));
        hit.map(|hit| hit.seen_by(&camera.projection))
    })
}

/// The number of primitives that are tested exactly for each of some pixels.
pub fn candidates(camera: &Camera, geometry: &Geometry, pixels: &[[u32; 2]]) -> Vec<usize> {
    by_area(camera, geometry, pixels, |_, primitives| primitives.len())
}

/// Calls `visit` with each pixel and the primitives that its ray may meet.
fn by_area<T: Send + Clone>(
    camera: &Camera,
    geometry: &Geometry,
    pixels: &[[u32; 2]],
    visit: impl Fn([u32; 2], &[InstancedId]) -> T + Sync,
) -> Vec<T> {
    assert!(
        geometry.primitive_count() <= MAX_PRIMITIVES,
        "too many primitives for one list"
    );
    let [width, height] = camera.resolution;
    let subdivision = Subdivision {
        geometry,
        camera,
        columns: (0..width)
            .map(|x| camera.plane_coordinates(x, 0)[0])
            .collect(),
        rows: (0..height)
            .map(|y| camera.plane_coordinates(0, y)[1])
            .collect(),
        visit,
    };
    let mut answers: Vec<Option<T>> = vec![None; pixels.len()];
    let mut pending: Vec<PendingPixel<T>> = answers
        .iter_mut()
        .zip(pixels)
        .map(|(answer, pixel)| PendingPixel {
            place: *pixel,
            answer,
        })
        .collect();
    let all: Vec<InstancedId> = geometry.all().collect();
    subdivision.answer(PixelBounds::of_film(width, height), &mut pending, &all);
    answers
        .into_iter()
        .map(|answer| answer.expect("every pixel lies in a part of the film"))
        .collect()
}

/// A pixel, and the place for its answer.
struct PendingPixel<'a, T> {
    place: [u32; 2],
    answer: &'a mut Option<T>,
}

struct Subdivision<'a, F> {
    geometry: &'a Geometry,
    camera: &'a Camera,
    /// The coordinates of the rays of each column in the plane at distance 1.
    columns: Vec<f64>,
    /// The coordinates of the rays of each row.
    rows: Vec<f64>,
    visit: F,
}

impl<F> Subdivision<'_, F> {
    /// Answers all `pixels` of `area`, given the `primitives` that its rays may meet.
    fn answer<T: Send + Clone>(
        &self,
        area: PixelBounds,
        pixels: &mut [PendingPixel<T>],
        primitives: &[InstancedId],
    ) where
        F: Fn([u32; 2], &[InstancedId]) -> T + Sync,
    {
        let Some(first) = pixels.first().map(|pixel| pixel.place) else {
            return;
        };
        // The rectangle of a single pixel rules out the most.
        let is_one = pixels.iter().all(|pixel| pixel.place == first);
        let area = match is_one {
            true => PixelBounds {
                x0: first[0],
                x1: first[0] + 1,
                y0: first[1],
                y1: first[1] + 1,
            },
            false => area,
        };
        let met = self.met(&self.beam(&area, pixels), primitives);
        if is_one {
            let answer = (self.visit)(first, &met);
            return pixels
                .iter_mut()
                .for_each(|pixel| *pixel.answer = Some(answer.clone()));
        }
        let (axis, middle) = match area.width() >= area.height() {
            true => (0, area.x0 + area.width() / 2),
            false => (1, area.y0 + area.height() / 2),
        };
        let (low, high) = match axis {
            0 => (
                PixelBounds { x1: middle, ..area },
                PixelBounds { x0: middle, ..area },
            ),
            _ => (
                PixelBounds { y1: middle, ..area },
                PixelBounds { y0: middle, ..area },
            ),
        };
        pixels.sort_by_key(|pixel| pixel.place[axis] >= middle);
        let (before, after) =
            pixels.split_at_mut(pixels.partition_point(|pixel| pixel.place[axis] < middle));
        rayon::join(
            || self.answer(low, before, &met),
            || self.answer(high, after, &met),
        );
    }

    /// The beam of the rays of `pixels`, which lie in `area`.
    fn beam<T>(&self, area: &PixelBounds, pixels: &[PendingPixel<T>]) -> Beam {
        if !self.camera.projection.is_linear() {
            let rays = pixels.iter().map(|pixel| pixel.place);
            return Beam::around(rays.map(|[x, y]| self.camera.ray(x, y)));
        }
        let hull = |values: &[f64]| Bracket {
            low: values.iter().copied().fold(f64::INFINITY, f64::min),
            high: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        };
        let columns = hull(&self.columns[area.x0 as usize..area.x1 as usize]);
        let rows = hull(&self.rows[area.y0 as usize..area.y1 as usize]);
        Beam::through(self.camera, columns, rows)
    }

    /// The `primitives` that a ray of the beam may meet.
    fn met(&self, beam: &Beam, primitives: &[InstancedId]) -> Vec<InstancedId> {
        let is_met =
            |placed: &&InstancedId| beam.may_meet(&bounds_of(&self.geometry.surface(**placed)));
        match primitives.len() {
            0..SHORT => primitives.iter().filter(is_met).copied().collect(),
            _ => primitives.par_iter().filter(is_met).copied().collect(),
        }
    }
}

/// A box around a primitive, evidently right: that of its corners, or that of a quadric's box in
/// object space.
fn bounds_of(surface: &Primitive) -> Bounds {
    match surface {
        Primitive::Triangle(triangle) => Bounds::of(triangle.0),
        Primitive::Quadric(quadric) => bounds_of_quadric(quadric),
        Primitive::Segment(segment) => bounds_of_segment(segment),
    }
}

/// How often the radius a point is away from the axis at most, with room for roundings.
fn widening(form: &Form) -> f64 {
    let most = match form {
        // Downwards, z / z_max is largest at the lower end.
        Form::Revolved(Revolved::Paraboloid(cut)) => (cut.z_min / cut.z_max).max(1.0).sqrt(),
        Form::Revolved(Revolved::Hyperboloid(hyperboloid)) => {
            // The absolute terms of (1 + along z^2) / across.
            let [low, high] = hyperboloid.ends();
            let highest = low.abs().max(high.abs());
            let terms = 1.0 + hyperboloid.along.abs() * (highest * highest);
            (terms / hyperboloid.across.abs()).sqrt()
        }
        _ => return 1.0,
    };
    most * (1.0 + 16.0 * f64::EPSILON)
}

/// Transforms the box in object space to the world: along an axis it reaches as far as the sum of
/// its absolute half widths times the absolute entries of the matrix. A factor covers all
/// roundings.
fn bounds_of_quadric(
    Quadric {
        world_from_object: m,
        radius,
        form,
    }: &Quadric,
) -> Bounds {
    let [low, high] = match form {
        Form::Sphere(_) => [-radius, *radius],
        Form::Cylinder(cut) => [cut.z_min, cut.z_max],
        Form::Disk(disk) => [disk.height; 2],
        Form::Revolved(revolved) => revolved.ends(),
        Form::Patch => return Bounds::of([0, 1, 2, 3].map(|k| Point::from(m.column(k)))),
    };
    let radius = radius * widening(form);
    let highest = low.abs().max(high.abs());
    let reach = |k: usize| {
        let [x, y, z, offset] = m.rows[k].map(f64::abs);
        let reach = (x + y) * radius + z * highest;
        // Covers the rounding of the sum with the offset, and underflow.
        reach * (1.0 + 16.0 * f64::EPSILON) + offset * f64::EPSILON + f64::MIN_POSITIVE
    };
    let corner = |sign: f64| {
        let at = |k: usize| m.rows[k][3] + sign * reach(k);
        Point::new(at(0), at(1), at(2))
    };
    Bounds {
        low: corner(-1.0),
        high: corner(1.0),
    }
}

/// The box around both ends in the world, wider by the half width times the absolute entries of the
/// matrix. A factor covers all roundings.
fn bounds_of_segment(segment: &Segment) -> Bounds {
    let [a, b] = segment.ends;
    let [first, last] = segment.half_widths;
    let ranges = segment.world_from_object.rows.map(|m| {
        let at = |p: Point| m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
        let farthest = |k: usize| a[k].abs().max(b[k].abs()) + first.max(last);
        let terms = (0..3).map(|k| m[k].abs() * farthest(k)).sum::<f64>() + m[3].abs();
        let reach = (m[0].abs() + m[1].abs() + m[2].abs()) * first.max(last)
            + terms * 16.0 * f64::EPSILON
            + f64::MIN_POSITIVE;
        [at(a).min(at(b)) - reach, at(a).max(at(b)) + reach]
    });
    let corner = |end: usize| Point::new(ranges[0][end], ranges[1][end], ranges[2][end]);
    Bounds {
        low: corner(0),
        high: corner(1),
    }
}
