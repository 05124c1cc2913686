//! Everything that a ray meets or passes, without any tree.

use super::film_space::FilmSpace;
use crate::exact::{Bracket, Root};
use crate::geometry::Ray;
use crate::scene::Scene;
use crate::shape::{FilterRay, Placed, Primitive, Shapes, Surface, Verdict};
use rayon::prelude::*;
use std::cmp::Ordering;

/// Primitives that are looked at, at most: some seconds.
pub const MAX_SCANNED: u64 = 200_000_000;

/// What is near a ray.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// Primitives that it meets.
    pub met: u64,
    /// The nearest of them; of several, the first in the file.
    pub first: Option<Placed>,
    /// The one after that.
    pub next: Option<Next>,
    /// Where it meets none: what it passes most closely.
    pub missed: Option<Missed>,
    /// Spheres, cylinders and disks, whose distance to a ray that misses them is not measured.
    pub unmeasured: u64,
}

/// The second nearest hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Next {
    /// What would be hit if the first one were not there.
    pub primitive: Placed,
    /// Where the planar depth lies.
    pub z: Bracket,
    /// How much farther the planar depth is, in `f64`.
    pub farther: f64,
    /// Whether both are at exactly the same depth: the first in the file wins (rule E3).
    pub is_tie: bool,
}

/// A triangle beside the ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missed {
    /// The triangle.
    pub primitive: Placed,
    /// Pixels on the film from the pixel's centre to the nearest edge.
    pub on_film: f64,
}

/// What some primitives contribute.
#[derive(Default)]
struct Part {
    hits: Vec<(Placed, Bracket)>,
    missed: Option<Missed>,
}

impl Scan {
    /// Looks at every primitive; `None` where there are too many. Distances to what is missed are measured if `is_miss`.
    pub(super) fn of(scene: &Scene, pixel: [u32; 2], ray: &Ray, is_miss: bool) -> Option<Scan> {
        let shapes = &scene.shapes;
        if shapes.primitive_count() > MAX_SCANNED {
            return None;
        }
        let film = is_miss
            .then(|| FilmSpace::new(&scene.camera, pixel))
            .flatten();
        let filter_ray = ray.can_hit().then(|| FilterRay::new(ray));
        let look = |mut part: Part, (placed, surface): (Placed, Surface)| {
            part.hits.extend(
                filter_ray
                    .as_ref()
                    .and_then(|ray| meet(&surface, ray))
                    .map(|t| (placed, t)),
            );
            if let (Surface::Triangle(triangle), Some(film)) = (&surface, &film) {
                let missed = film.distance(triangle).map(|on_film| Missed {
                    primitive: placed,
                    on_film,
                });
                part.missed = closer(part.missed, missed, shapes);
            }
            part
        };
        let part =
            all(shapes)
                .fold(Part::default, look)
                .reduce(Part::default, |mut part, other| {
                    part.hits.extend(other.hits);
                    Part {
                        missed: closer(part.missed, other.missed, shapes),
                        hits: part.hits,
                    }
                });
        let unmeasured = if is_miss {
            all(shapes)
                .filter(|(placed, _)| placed.primitive().is_sphere())
                .count()
        } else {
            0
        };
        let met = part.hits.len() as u64;
        let (first, next) = nearest_two(part.hits, shapes, ray);
        Some(Scan {
            met,
            first,
            next,
            missed: part.missed,
            unmeasured: unmeasured as u64,
        })
    }
}

/// All primitives, where they are in the world.
fn all(shapes: &Shapes) -> impl ParallelIterator<Item = (Placed, Surface)> {
    let triangles = (0..shapes.triangle_count())
        .into_par_iter()
        .map(Primitive::triangle);
    let own = triangles
        .chain(
            (0..shapes.sphere_count())
                .into_par_iter()
                .map(Primitive::sphere),
        )
        .map(Placed::alone);
    let instances = (0..shapes.instances().len()).into_par_iter();
    let instanced = instances.flat_map_iter(|instance| {
        let mut pose = shapes.pose(instance);
        let primitives = shapes.object_of(instance).shapes().primitives();
        primitives.map(move |primitive| {
            (
                Placed::in_instance(instance, primitive),
                pose.surface(primitive),
            )
        })
    });
    own.map(|placed| (placed, shapes.surface(placed)))
        .chain(instanced)
}

fn meet(surface: &Surface, ray: &FilterRay) -> Option<Bracket> {
    if !surface.can_be_hit() {
        return None;
    }
    match surface.filter(ray) {
        Verdict::Miss => None,
        Verdict::Hit(t) => Some(t),
        Verdict::Unsure => surface.exact(&ray.ray).map(|t| t.bracket()),
    }
}

fn closer(a: Option<Missed>, b: Option<Missed>, shapes: &Shapes) -> Option<Missed> {
    let key = |missed: &Missed| (missed.on_film, shapes.number(missed.primitive));
    a.into_iter().chain(b).min_by(|a, b| {
        let ((a, p), (b, q)) = (key(a), key(b));
        a.total_cmp(&b).then(p.cmp(&q))
    })
}

/// The nearest hit and the one after it, by exact comparisons of those whose brackets leave a doubt.
fn nearest_two(
    mut hits: Vec<(Placed, Bracket)>,
    shapes: &Shapes,
    ray: &Ray,
) -> (Option<Placed>, Option<Next>) {
    let mut ends: Vec<f64> = hits.iter().map(|(_, t)| t.high).collect();
    if ends.len() > 2 {
        let (_, second, _) = ends.select_nth_unstable_by(1, f64::total_cmp);
        let limit = *second;
        hits.retain(|(_, t)| t.low <= limit);
    }
    let mut best: Vec<(Root, Placed)> = Vec::with_capacity(3);
    for (placed, _) in hits {
        best.push((shapes.surface(placed).exact_t(ray), placed));
        best.sort_by(|(a, p), (b, q)| {
            a.cmp(b)
                .then_with(|| shapes.number(*p).cmp(&shapes.number(*q)))
        });
        best.truncate(2);
    }
    let next = match &best[..] {
        [(first, _), (second, primitive)] => {
            let (z, before) = (second.bracket(), first.bracket());
            let middle = |t: &Bracket| t.low + (t.high - t.low) / 2.0;
            let is_tie = first.cmp(second) == Ordering::Equal;
            let farther = if is_tie {
                0.0
            } else {
                middle(&z) - middle(&before)
            };
            Some(Next {
                primitive: *primitive,
                z,
                farther,
                is_tie,
            })
        }
        _ => None,
    };
    (best.first().map(|(_, placed)| *placed), next)
}
