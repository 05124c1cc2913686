//! The report on a pixel: one struct for `--json`, whose keys are its field names, and for text.

mod text;

use crate::accel::{Precision, SplitMethod, TraversalCounts};
use crate::pixel::{Answer, CutHit, Explanation, HitDetails, Margin, Missed, Next, Scan};
use crate::scene::Scene;
use crate::shape::{InstancedId, Primitive};
use serde::Serialize;
use std::path::Path;

#[derive(Debug, Serialize)]
pub(super) struct Report<'a> {
    scene: String,
    pixel: [u32; 2],
    film: [u32; 2],
    camera: &'static str,
    origin: [f64; 3],
    direction: [f64; 3],
    can_hit: bool,
    hit: Option<Hit<'a>>,
    /// Primitives that the ray hits; this and the next three are null if there are too many to
    /// scan.
    met: Option<u64>,
    behind: Option<Behind<'a>>,
    nearest_missed: Option<NearestMissed<'a>>,
    /// The nearest hit that an alpha cuts away, if it is nearer than the hit.
    cut: Option<Cut<'a>>,
    unmeasured: Option<u64>,
    answers: Vec<AnswerLine>,
    costs: Vec<Cost>,
    /// Null if the reference was not computed.
    reference_agrees: Option<bool>,
    contradictions: &'a [String],
    /// Primitives of the scene.
    #[serde(skip)]
    primitives: u64,
}

#[derive(Debug, Serialize)]
struct PrimitiveName<'a> {
    prim: u32,
    id: u32,
    shape: Option<&'a str>,
    place: Option<String>,
    /// From 1; 0 for a primitive in no instance.
    instance: usize,
    instance_place: Option<String>,
}

#[derive(Debug, Serialize)]
struct Hit<'a> {
    #[serde(flatten)]
    primitive: PrimitiveName<'a>,
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
struct Behind<'a> {
    #[serde(flatten)]
    primitive: PrimitiveName<'a>,
    #[serde(rename = "Z_bracket")]
    bracket: [f64; 2],
    farther: f64,
    tie: bool,
}

#[derive(Debug, Serialize)]
struct NearestMissed<'a> {
    #[serde(flatten)]
    primitive: PrimitiveName<'a>,
    /// Pixels.
    on_film: f64,
}

#[derive(Debug, Serialize)]
struct AnswerLine {
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
struct Cut<'a> {
    #[serde(flatten)]
    primitive: PrimitiveName<'a>,
    #[serde(rename = "Z")]
    z: f64,
    u: f64,
    v: f64,
    alpha: f64,
}

#[derive(Debug, Serialize)]
struct Cost {
    accel: &'static str,
    nodes: u64,
    primitives: u64,
}

/// The precision of baseline kernels in JSON.
const BASELINE: &str = "yardstick";

impl<'a> Report<'a> {
    pub(super) fn new(path: &Path, scene: &'a Scene, explanation: &'a Explanation) -> Report<'a> {
        let Explanation {
            ray,
            hit,
            contradictions,
            ..
        } = explanation;
        let scan = explanation.scan.as_ref();
        let cost = |(method, counts): &(SplitMethod, TraversalCounts)| Cost {
            accel: method.name(),
            nodes: counts.nodes,
            primitives: counts.primitives,
        };
        Report {
            scene: path.display().to_string(),
            pixel: explanation.pixel,
            film: scene.film.resolution,
            camera: scene.camera.projection.name(),
            origin: ray.origin.to_array(),
            direction: ray.direction.to_array(),
            can_hit: ray.can_hit(),
            hit: hit.as_ref().map(|hit| Hit::new(scene, hit)),
            met: scan.map(|scan| scan.met),
            behind: scan.and_then(|scan| Behind::new(scene, scan)),
            nearest_missed: scan.and_then(|scan| NearestMissed::new(scene, scan)),
            cut: scan.and_then(|scan| Cut::new(scene, scan, hit.as_ref())),
            unmeasured: scan.map(|scan| scan.unmeasured),
            answers: explanation.answers.iter().map(AnswerLine::new).collect(),
            costs: explanation.costs.iter().map(cost).collect(),
            reference_agrees: explanation
                .has_reference
                .then_some(contradictions.is_empty()),
            contradictions,
            primitives: scene.geometry.primitive_count(),
        }
    }
}

impl<'a> PrimitiveName<'a> {
    fn new(scene: &'a Scene, placed: InstancedId) -> PrimitiveName<'a> {
        let id = scene.geometry.shape_number(placed);
        let places = scene.locations.as_ref();
        let shape = places.and_then(|places| places.shape(id));
        let instance = placed.instance();
        let of_instance = places.zip(instance);
        let of_instance = of_instance.and_then(|(places, instance)| places.instance(instance));
        PrimitiveName {
            prim: scene.geometry.image_number(placed),
            id,
            shape: shape.as_ref().map(|(name, _)| *name),
            place: shape.map(|(_, place)| place.to_string()),
            instance: instance.map_or(0, |instance| instance + 1),
            instance_place: of_instance.map(|place| place.to_string()),
        }
    }
}

impl<'a> Hit<'a> {
    fn new(scene: &'a Scene, hit: &HitDetails) -> Hit<'a> {
        let (barycentric, edge_on_film, clearance) = match hit.margin {
            Margin::Triangle {
                barycentric,
                on_film,
            } => (Some(barycentric), on_film, None),
            Margin::Quadric { clearance } => (None, None, clearance),
        };
        let corners = match &hit.surface {
            Primitive::Triangle(triangle) => Some(triangle.0.map(|corner| corner.to_array())),
            Primitive::Quadric(_) | Primitive::Segment(_) => None,
        };
        Hit {
            primitive: PrimitiveName::new(scene, hit.primitive),
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

impl<'a> Behind<'a> {
    fn new(scene: &'a Scene, scan: &Scan) -> Option<Behind<'a>> {
        let Next {
            primitive,
            z,
            farther,
            is_tie,
        } = scan.next?;
        Some(Behind {
            primitive: PrimitiveName::new(scene, primitive),
            bracket: [z.low, z.high],
            farther,
            tie: is_tie,
        })
    }
}

impl<'a> NearestMissed<'a> {
    fn new(scene: &'a Scene, scan: &Scan) -> Option<NearestMissed<'a>> {
        let Missed { primitive, on_film } = scan.missed?;
        Some(NearestMissed {
            primitive: PrimitiveName::new(scene, primitive),
            on_film,
        })
    }
}

impl<'a> Cut<'a> {
    fn new(scene: &'a Scene, scan: &Scan, hit: Option<&HitDetails>) -> Option<Cut<'a>> {
        let CutHit {
            primitive,
            z,
            uv: [u, v],
            alpha,
        } = scan.cut?;
        let is_nearer = hit.is_none_or(|hit| z < hit.z.high);
        is_nearer.then(|| Cut {
            primitive: PrimitiveName::new(scene, primitive),
            z,
            u,
            v,
            alpha,
        })
    }
}

impl AnswerLine {
    fn new(answer: &Answer) -> AnswerLine {
        let (found, ulps) = (answer.found, answer.ulps);
        AnswerLine {
            precision: answer.precision.map_or(BASELINE, Precision::name),
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
