//! The report on a pixel: one struct for `--json`, whose keys are its field names, and for text.

use crate::cli::terminal::words::{counted, line, lines};
use feimos::accel::Precision;
use feimos::error::printable;
use feimos::pixel::{
    Answer, Explanation, HitDetails, MAX_REFERENCED, MAX_SCANNED, Margin, Missed, Next, Scan,
};
use feimos::scene::Scene;
use feimos::shape::{InstancedId, Primitive};
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
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
    /// Primitives that the ray hits; this and the next three are null if there are too many to scan.
    met: Option<u64>,
    behind: Option<Behind<'a>>,
    nearest_missed: Option<NearestMissed<'a>>,
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
        let cost =
            |(method, work): &(feimos::accel::SplitMethod, feimos::accel::TraversalCounts)| Cost {
                accel: method.name(),
                nodes: work.nodes,
                primitives: work.primitives,
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
            Primitive::Quadric(_) => None,
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

impl Display for Report<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let ([x, y], [width, height]) = (self.pixel, self.film);
        writeln!(
            f,
            "{}, pixel {x},{y} of {width} x {height}",
            printable(&self.scene)
        )?;
        lines(f, "ray", self.ray_lines())?;
        match &self.hit {
            Some(hit) => hit.fmt(f)?,
            None => line(f, "hit", "nothing")?,
        }
        self.fmt_scan(f)?;
        for group in self.answers.chunk_by(|a, b| a.precision == b.precision) {
            let name = group[0].precision;
            let name = if name == BASELINE { "baselines" } else { name };
            lines(f, name, group.iter().map(ToString::to_string))?;
        }
        lines(f, "tested", self.costs.iter().map(ToString::to_string))?;
        line(f, "reference", &self.reference())
    }
}

impl Report<'_> {
    fn ray_lines(&self) -> Vec<String> {
        let [x, y, z] = self.direction;
        let mut lines = vec![format!(
            "{} camera, from {} along {}, of length {}",
            self.camera,
            triple(self.origin),
            triple(self.direction),
            (x * x + y * y + z * z).sqrt()
        )];
        if !self.can_hit {
            lines.push("it is not finite or has no direction: it cannot hit anything".to_owned());
        }
        lines
    }

    fn fmt_scan(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Some(met) = self.met else {
            let text = format!("not scanned: more than {MAX_SCANNED} primitives");
            return line(f, "others", &text);
        };
        match &self.behind {
            Some(behind) => line(f, "behind", &behind.to_string())?,
            None if met > 0 => line(f, "behind", "nothing")?,
            None => {}
        }
        if let Some(NearestMissed { primitive, on_film }) = &self.nearest_missed {
            line(
                f,
                "nearest",
                &format!("{primitive}, {on_film} pixels away on the film"),
            )?;
        }
        if let Some(unmeasured @ 1..) = self.unmeasured {
            line(
                f,
                "",
                &format!("not measured: {}", counted(unmeasured, "quadric")),
            )?;
        }
        if met > 1 {
            line(
                f,
                "",
                &format!("the ray hits {} in all", counted(met, "primitive")),
            )?;
        }
        Ok(())
    }

    fn reference(&self) -> String {
        match self.reference_agrees {
            _ if !self.contradictions.is_empty() => "CONTRADICTION: see the error".to_owned(),
            None => {
                format!("not computed: it takes too long for more than {MAX_REFERENCED} primitives")
            }
            Some(_) => format!(
                "agrees: exact arithmetic on {}",
                counted(self.primitives, "primitive")
            ),
        }
    }
}

/// A primitive by its numbers, and the place of its shape in the file.
impl Display for PrimitiveName<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "prim {} of shape {}", self.prim, self.id)?;
        if let (Some(shape), Some(place)) = (self.shape, &self.place) {
            write!(f, ": {}, {place}", printable(shape))?;
        }
        Ok(())
    }
}

impl Display for Hit<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [low, high] = self.bracket;
        line(
            f,
            "hit",
            &format!("Z {}, t {}; Z is from {low} to {high}", self.z, self.t),
        )?;
        line(f, "point", &triple(self.point))?;
        line(
            f,
            "normal",
            &self.normal.map_or("unknown".to_owned(), triple),
        )?;
        line(f, "primitive", &format!("{} {}", self.kind, self.primitive))?;
        if let Some(place) = &self.primitive.instance_place {
            line(
                f,
                "instance",
                &format!("{}, {place}", self.primitive.instance),
            )?;
        }
        lines(f, "corners", self.corners.into_iter().flatten().map(triple))?;
        line(f, "margin", &self.margin())
    }
}

impl Hit<'_> {
    fn margin(&self) -> String {
        if let Some(barycentric) = self.barycentric {
            let on_film = self.edge_on_film.map_or(String::new(), |pixels| {
                format!("; {pixels} pixels from the nearest edge on the film")
            });
            let rim = "; exactly on its edge, which counts as hit (rule E1)";
            let rim = if self.on_rim { rim } else { "" };
            let barycentric = triple(barycentric);
            return format!("barycentric {barycentric}, where 0 would be on an edge{on_film}{rim}");
        }
        match self.clearance {
            _ if self.on_rim => {
                "the ray touches it exactly, which counts as hit (rules E2 and E5)".to_owned()
            }
            Some(clearance) => format!(
                "(b^2 - ac) / b^2 of its equation is {clearance}: 0 would be a ray that touches it"
            ),
            None => "not measured".to_owned(),
        }
    }
}

impl Display for Behind<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Behind {
            primitive,
            bracket: [low, _],
            farther,
            tie,
        } = self;
        if *tie {
            let rule = "the first in the file wins (rule E3)";
            return write!(f, "{primitive} is at exactly the same depth: {rule}");
        }
        write!(f, "{primitive}, Z about {low}: ")?;
        if *farther < 1e-4 {
            write!(f, "{farther:e} farther")
        } else {
            write!(f, "{farther} farther")
        }
    }
}

impl Display for AnswerLine {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{:16}  ", self.way)?;
        let (Some(z), Some(t)) = (self.z, self.t) else {
            return f.write_str("miss");
        };
        write!(f, "prim {}", self.prim)?;
        if self.instance > 0 {
            write!(f, " in instance {}", self.instance)?;
        }
        write!(f, ", Z {z}, t {t}")?;
        match (self.z_ulps, self.t_ulps) {
            (Some(z), Some(t)) if self.precision != Precision::Exact.name() => {
                write!(f, ": off by {z} and {t} ulps")
            }
            _ => Ok(()),
        }
    }
}

impl Display for Cost {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (nodes, primitives) = (
            counted(self.nodes, "node"),
            counted(self.primitives, "primitive"),
        );
        write!(f, "{:6}  {nodes}, {primitives}", self.accel)
    }
}

fn triple([x, y, z]: [f64; 3]) -> String {
    format!("({x}, {y}, {z})")
}
