//! What `--json` prints of a pixel.

use feimos::accel::Precision;
use feimos::pixel::{Answer, Explanation, HitDetails, Margin, Scan};
use feimos::scene::Scene;
use feimos::shape::{InstancedId, Primitive};
use serde::Serialize;
use std::path::Path;

/// One object.
#[derive(Debug, Serialize)]
pub(super) struct Record<'a> {
    scene: String,
    pixel: [u32; 2],
    film: [u32; 2],
    camera: &'static str,
    origin: [f64; 3],
    direction: [f64; 3],
    can_hit: bool,
    hit: Option<HitRecord<'a>>,
    /// Primitives that the ray meets; null where there are too many to look at, as the three below.
    met: Option<u64>,
    behind: Option<NextRecord<'a>>,
    nearest_missed: Option<MissedRecord<'a>>,
    unmeasured: Option<u64>,
    answers: Vec<AnswerRecord>,
    costs: Vec<CostRecord>,
    /// Whether the reference agrees; null where it was not asked.
    reference_agrees: Option<bool>,
    contradictions: &'a [String],
}

#[derive(Debug, Serialize)]
struct PrimitiveRecord<'a> {
    prim: u32,
    id: u32,
    shape: Option<&'a str>,
    place: Option<String>,
    /// From 1; 0 for what is in none.
    instance: usize,
    instance_place: Option<String>,
}

#[derive(Debug, Serialize)]
struct HitRecord<'a> {
    #[serde(flatten)]
    primitive: PrimitiveRecord<'a>,
    kind: &'static str,
    #[serde(rename = "Z")]
    z: f32,
    t: f32,
    #[serde(rename = "Z_bracket")]
    bracket: [f64; 2],
    point: [f64; 3],
    normal: Option<[f64; 3]>,
    corners: Option<[[f64; 3]; 3]>,
    barycentric: Option<[f64; 3]>,
    /// Pixels.
    edge_on_film: Option<f64>,
    /// (b^2 - ac) / b^2 of a sphere or a cylinder.
    clearance: Option<f64>,
    on_rim: bool,
}

#[derive(Debug, Serialize)]
struct NextRecord<'a> {
    #[serde(flatten)]
    primitive: PrimitiveRecord<'a>,
    #[serde(rename = "Z_bracket")]
    bracket: [f64; 2],
    farther: f64,
    tie: bool,
}

#[derive(Debug, Serialize)]
struct MissedRecord<'a> {
    #[serde(flatten)]
    primitive: PrimitiveRecord<'a>,
    /// Pixels.
    on_film: f64,
}

#[derive(Debug, Serialize)]
struct AnswerRecord {
    precision: &'static str,
    way: &'static str,
    hit: bool,
    prim: u32,
    instance: u32,
    #[serde(rename = "Z")]
    z: Option<f32>,
    t: Option<f32>,
    #[serde(rename = "Z_ulps")]
    z_ulps: Option<u32>,
    t_ulps: Option<u32>,
}

#[derive(Debug, Serialize)]
struct CostRecord {
    accel: &'static str,
    nodes: u64,
    primitives: u64,
}

impl<'a> Record<'a> {
    pub(super) fn new(path: &Path, scene: &'a Scene, explanation: &'a Explanation) -> Record<'a> {
        let Explanation {
            pixel,
            ray,
            hit,
            scan,
            answers,
            costs,
            is_judged,
            contradictions,
        } = explanation;
        let scanned = |of: fn(&Scan) -> u64| scan.as_ref().map(of);
        Record {
            scene: path.display().to_string(),
            pixel: *pixel,
            film: scene.film.resolution,
            camera: scene.camera.projection.name(),
            origin: ray.origin.to_array(),
            direction: ray.direction.to_array(),
            can_hit: ray.can_hit(),
            hit: hit.as_ref().map(|hit| HitRecord::new(scene, hit)),
            met: scanned(|scan| scan.met),
            behind: scan
                .as_ref()
                .and_then(|scan| scan.next)
                .map(|next| NextRecord {
                    primitive: PrimitiveRecord::new(scene, next.primitive),
                    bracket: [next.z.low, next.z.high],
                    farther: next.farther,
                    tie: next.is_tie,
                }),
            nearest_missed: scan
                .as_ref()
                .and_then(|scan| scan.missed)
                .map(|missed| MissedRecord {
                    primitive: PrimitiveRecord::new(scene, missed.primitive),
                    on_film: missed.on_film,
                }),
            unmeasured: scanned(|scan| scan.unmeasured),
            answers: answers.iter().map(AnswerRecord::new).collect(),
            costs: costs
                .iter()
                .map(|(method, work)| CostRecord {
                    accel: method.name(),
                    nodes: work.nodes,
                    primitives: work.primitives,
                })
                .collect(),
            reference_agrees: is_judged.then_some(contradictions.is_empty()),
            contradictions,
        }
    }
}

impl<'a> PrimitiveRecord<'a> {
    fn new(scene: &'a Scene, placed: InstancedId) -> PrimitiveRecord<'a> {
        let id = scene.geometry.shape_number(placed);
        let places = scene.locations.as_ref();
        let shape = places.and_then(|places| places.shape(id));
        let instance = placed.instance();
        let instance_place = places
            .zip(instance)
            .and_then(|(places, instance)| places.instance(instance));
        PrimitiveRecord {
            prim: scene.geometry.image_number(placed),
            id,
            shape: shape.as_ref().map(|(name, _)| *name),
            place: shape.map(|(_, place)| place.to_string()),
            instance: instance.map_or(0, |instance| instance + 1),
            instance_place: instance_place.map(|place| place.to_string()),
        }
    }
}

impl<'a> HitRecord<'a> {
    fn new(scene: &'a Scene, hit: &HitDetails) -> HitRecord<'a> {
        let (barycentric, edge_on_film, clearance) = match hit.margin {
            Margin::Triangle {
                barycentric,
                on_film,
            } => (Some(barycentric), on_film, None),
            Margin::Quadric { clearance } => (None, None, clearance),
        };
        let corners = match &hit.surface {
            Primitive::Triangle(triangle) => Some(triangle.0.map(|corner| corner.to_array())),
            Primitive::Quadric(_) => None,
        };
        HitRecord {
            primitive: PrimitiveRecord::new(scene, hit.primitive),
            kind: hit.surface.name(),
            z: hit.depth.z,
            t: hit.depth.distance,
            bracket: [hit.z.low, hit.z.high],
            point: hit.point.to_array(),
            normal: hit.normal.map(|normal| normal.to_array()),
            corners,
            barycentric,
            edge_on_film,
            clearance,
            on_rim: hit.margin.is_on_rim(),
        }
    }
}

impl AnswerRecord {
    fn new(answer: &Answer) -> AnswerRecord {
        let (found, ulps) = (answer.found, answer.ulps);
        AnswerRecord {
            precision: answer.precision.map_or("yardstick", Precision::name),
            way: answer.way,
            hit: found.is_some(),
            prim: found.map_or(0, |found| found.prim),
            instance: found.map_or(0, |found| found.instance),
            z: found.map(|found| found.z),
            t: found.map(|found| found.t),
            z_ulps: ulps.map(|[z, _]| z),
            t_ulps: ulps.map(|[_, t]| t),
        }
    }
}
