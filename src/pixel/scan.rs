//! Scans all primitives for those that a ray hits or passes, without a tree.

use super::film_space::FilmSpace;
use crate::accel::distance_bracket;
use crate::exact::{Bracket, Root};
use crate::geometry::Ray;
use crate::scene::Scene;
use crate::shape::{FilterRay, FilterResult, Geometry, InstancedId, Primitive};
use rayon::prelude::*;
use std::cmp::Ordering;

/// Scenes with more primitives are not scanned: it would take more than some seconds.
pub const MAX_SCANNED: u64 = 200_000_000;

/// The primitives near a ray.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// The number of primitives that it hits.
    pub met: u64,
    /// The nearest of them; of several at one depth the first in the file.
    pub first: Option<InstancedId>,
    /// The second nearest.
    pub next: Option<Next>,
    /// The triangle that it passes most closely, if it hits nothing.
    pub missed: Option<Missed>,
    /// The nearest hit that an alpha cuts away (rule A1).
    pub cut: Option<CutHit>,
    /// The number of quadrics, whose distance to a ray that misses them is not measured.
    pub unmeasured: u64,
}

/// The second nearest hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Next {
    /// The primitive and its instance.
    pub primitive: InstancedId,
    /// The bracket of the depth `Z`.
    pub z: Bracket,
    /// The difference to the first depth, in `f64`.
    pub farther: f64,
    /// Both are at exactly the same depth: the first in the file wins (rule E3).
    pub is_tie: bool,
}

/// A hit that the alpha of its surface cuts away: the ray goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutHit {
    /// The primitive and its instance.
    pub primitive: InstancedId,
    /// The planar depth, rounded.
    pub z: f64,
    /// u and v there.
    pub uv: [f64; 2],
    /// The alpha there.
    pub alpha: f64,
}

/// A triangle beside the ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missed {
    /// The triangle.
    pub primitive: InstancedId,
    /// Distance on the film from the pixel's centre to the nearest edge, in pixels.
    pub on_film: f64,
}

/// The result for some primitives.
#[derive(Default)]
struct Part {
    hits: Vec<(InstancedId, Bracket)>,
    missed: Option<Missed>,
    cut: Option<CutHit>,
}

impl Scan {
    /// Scans every primitive; `None` if there are too many. Measures distances of missed triangles
    /// if `is_miss`.
    pub(super) fn of(scene: &Scene, pixel: [u32; 2], ray: &Ray, is_miss: bool) -> Option<Scan> {
        let geometry = &scene.geometry;
        if geometry.primitive_count() > MAX_SCANNED {
            return None;
        }
        let film = is_miss
            .then(|| FilmSpace::new(&scene.camera, pixel))
            .flatten();
        let filter_ray = ray.can_hit().then(|| FilterRay::new(ray));
        let look = |mut part: Part, (placed, surface): (InstancedId, Primitive)| {
            part.hits.extend(
                filter_ray
                    .as_ref()
                    .and_then(|ray| bracket_of_hit(geometry, placed, &surface, ray))
                    .map(|t| (placed, t)),
            );
            part.cut = nearer(part.cut, cut_hit(geometry, placed, ray), geometry);
            if let (Primitive::Triangle(triangle), Some(film)) = (&surface, &film) {
                let missed = film.distance(triangle).map(|on_film| Missed {
                    primitive: placed,
                    on_film,
                });
                part.missed = closer(part.missed, missed, geometry);
            }
            part
        };
        let part =
            all(geometry)
                .fold(Part::default, look)
                .reduce(Part::default, |mut part, other| {
                    part.hits.extend(other.hits);
                    Part {
                        cut: nearer(part.cut, other.cut, geometry),
                        missed: closer(part.missed, other.missed, geometry),
                        hits: part.hits,
                    }
                });
        let unmeasured = if is_miss { curved(geometry) } else { 0 };
        let met = part.hits.len() as u64;
        let is_planar = scene.camera.projection.has_planar_depth();
        let (first, next) = nearest_two(part.hits, geometry, ray, is_planar);
        Some(Scan {
            met,
            first,
            next,
            missed: part.missed,
            cut: part.cut,
            unmeasured,
        })
    }
}

/// The number of quadrics and segments, in instances too.
fn curved(geometry: &Geometry) -> u64 {
    let instances = 0..geometry.instances().len();
    let instanced = instances.map(|instance| geometry.object_of(instance).curved_count() as u64);
    geometry.curved_count() as u64 + instanced.sum::<u64>()
}

/// All primitives with their geometry in the world.
fn all(geometry: &Geometry) -> impl ParallelIterator<Item = (InstancedId, Primitive)> {
    let own = (0..geometry.own_count())
        .into_par_iter()
        .map(geometry.own_ids())
        .map(InstancedId::alone);
    let instances = (0..geometry.instances().len()).into_par_iter();
    let instanced = instances.flat_map_iter(|instance| {
        let mut pose = geometry.pose(instance);
        let primitives = geometry.object_of(instance).primitives();
        primitives.map(move |primitive| {
            (
                InstancedId::in_instance(instance, primitive),
                pose.surface(primitive),
            )
        })
    });
    own.map(|placed| (placed, geometry.surface(placed)))
        .chain(instanced)
}

fn bracket_of_hit(
    geometry: &Geometry,
    placed: InstancedId,
    surface: &Primitive,
    ray: &FilterRay,
) -> Option<Bracket> {
    if !surface.can_be_hit() {
        return None;
    }
    if geometry.alpha_of(placed).is_some() {
        return geometry.exact(placed, &ray.ray).map(|t| t.bracket());
    }
    match surface.filter(ray) {
        FilterResult::Miss => None,
        FilterResult::Hit(t) => Some(t),
        FilterResult::Unsure => surface.exact(&ray.ray).map(|t| t.bracket()),
    }
}

/// The first hit of `ray` with `placed`, if its alpha cuts it away.
fn cut_hit(geometry: &Geometry, placed: InstancedId, ray: &Ray) -> Option<CutHit> {
    let alpha = geometry.alpha_of(placed)?;
    let surface = geometry.surface(placed);
    if !ray.can_hit() || !surface.can_be_hit() || geometry.keeps(placed, ray, 0) {
        return None;
    }
    let t = surface.exact(ray)?.bracket();
    let uv = geometry.uv_of_hit(placed, ray, 0)?;
    Some(CutHit {
        primitive: placed,
        z: t.low + (t.high - t.low) / 2.0,
        uv,
        alpha: alpha.at(uv),
    })
}

fn nearer(a: Option<CutHit>, b: Option<CutHit>, geometry: &Geometry) -> Option<CutHit> {
    let key = |cut: &CutHit| (cut.z, geometry.number(cut.primitive));
    a.into_iter().chain(b).min_by(|a, b| {
        let ((a, p), (b, q)) = (key(a), key(b));
        a.total_cmp(&b).then(p.cmp(&q))
    })
}

fn closer(a: Option<Missed>, b: Option<Missed>, geometry: &Geometry) -> Option<Missed> {
    let key = |missed: &Missed| (missed.on_film, geometry.number(missed.primitive));
    a.into_iter().chain(b).min_by(|a, b| {
        let ((a, p), (b, q)) = (key(a), key(b));
        a.total_cmp(&b).then(p.cmp(&q))
    })
}

/// The nearest two hits. Exact comparisons decide between overlapping brackets. Without a planar
/// film, their depths are distances.
fn nearest_two(
    mut hits: Vec<(InstancedId, Bracket)>,
    geometry: &Geometry,
    ray: &Ray,
    is_planar: bool,
) -> (Option<InstancedId>, Option<Next>) {
    let mut ends: Vec<f64> = hits.iter().map(|(_, t)| t.high).collect();
    if ends.len() > 2 {
        let (_, second, _) = ends.select_nth_unstable_by(1, f64::total_cmp);
        let limit = *second;
        hits.retain(|(_, t)| t.low <= limit);
    }
    let mut best: Vec<(Root, InstancedId)> = Vec::with_capacity(3);
    for (placed, _) in hits {
        best.push((geometry.exact_t(placed, ray), placed));
        best.sort_by(|(a, p), (b, q)| {
            a.cmp(b)
                .then_with(|| geometry.number(*p).cmp(&geometry.number(*q)))
        });
        best.truncate(2);
    }
    let next = match &best[..] {
        [(first, _), (second, primitive)] => {
            let depth = |root: &Root| match is_planar {
                true => root.bracket(),
                false => distance_bracket(&root.bracket(), ray.direction),
            };
            let (z, before) = (depth(second), depth(first));
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
