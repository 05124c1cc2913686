//! What a person reads about a pixel: a line a subject, in aligned columns.

use crate::cli::terminal::words::counted;
use crate::cli::terminal::words::line;
use feimos::accel::Precision;
use feimos::error::printable;
use feimos::pixel::{
    Answer, Explanation, Found, HitDetails, MAX_JUDGED, MAX_SCANNED, Margin, Next, Scan,
};
use feimos::scene::Scene;
use feimos::shape::{InstancedId, Primitive};
use std::fmt::{self, Display, Formatter};
use std::path::Path;

/// All of it.
pub(super) struct Block<'a> {
    path: &'a Path,
    scene: &'a Scene,
    explanation: &'a Explanation,
}

impl<'a> Block<'a> {
    pub(super) fn new(path: &'a Path, scene: &'a Scene, explanation: &'a Explanation) -> Block<'a> {
        Block {
            path,
            scene,
            explanation,
        }
    }
}

impl Display for Block<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Explanation {
            pixel: [x, y],
            ray,
            hit,
            scan,
            ..
        } = self.explanation;
        let [width, height] = self.scene.film.resolution;
        let path = printable(&self.path.display().to_string());
        writeln!(f, "{path}, pixel {x},{y} of {width} x {height}")?;
        let kind = self.scene.camera.projection.name();
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        let length = ray.direction.dot(ray.direction).sqrt();
        let text = format!(
            "{kind} camera, from {} along {}, of length {length}",
            triple(origin),
            triple(direction)
        );
        line(f, "ray", &text)?;
        if !ray.can_hit() {
            line(
                f,
                "",
                "it is not finite, or goes nowhere: it can hit nothing",
            )?;
        }
        match hit {
            Some(hit) => self.tell_of_hit(f, hit)?,
            None => line(f, "hit", "nothing")?,
        }
        match scan {
            Some(scan) => self.tell_of_neighbours(f, scan)?,
            None => line(
                f,
                "others",
                &format!("not looked at: more than {MAX_SCANNED} primitives"),
            )?,
        }
        self.tell_of_answers(f)?;
        for (place, (method, work)) in self.explanation.costs.iter().enumerate() {
            let (nodes, primitives) = (
                counted(work.nodes, "node"),
                counted(work.primitives, "primitive"),
            );
            line(
                f,
                if place == 0 { "tested" } else { "" },
                &format!("{:6}  {nodes}, {primitives}", method.name()),
            )?;
        }
        line(f, "reference", &self.verdict())
    }
}

impl Block<'_> {
    fn tell_of_hit(&self, f: &mut Formatter<'_>, hit: &HitDetails) -> fmt::Result {
        let HitDetails { depth, z, .. } = hit;
        line(
            f,
            "hit",
            &format!(
                "Z {}, t {}; Z is from {} to {}",
                depth.z, depth.t, z.low, z.high
            ),
        )?;
        line(f, "point", &triple(hit.point.to_array()))?;
        let normal = hit
            .normal
            .map_or("unknown".to_owned(), |normal| triple(normal.to_array()));
        line(f, "normal", &normal)?;
        line(
            f,
            "primitive",
            &format!("{} {}", hit.surface.name(), self.name(hit.primitive)),
        )?;
        if let (Some(places), Some(instance)) = (&self.scene.places, hit.primitive.instance())
            && let Some(place) = places.instance(instance)
        {
            line(f, "instance", &format!("{}, {place}", instance + 1))?;
        }
        if let Primitive::Triangle(triangle) = &hit.surface {
            for (place, corner) in triangle.0.iter().enumerate() {
                line(
                    f,
                    if place == 0 { "corners" } else { "" },
                    &triple(corner.to_array()),
                )?;
            }
        }
        line(f, "margin", &margin(&hit.margin))
    }

    fn tell_of_neighbours(&self, f: &mut Formatter<'_>, scan: &Scan) -> fmt::Result {
        match &scan.next {
            Some(Next {
                primitive,
                is_tie: true,
                ..
            }) => {
                let text = format!(
                    "{} is at exactly the same depth: the first in the file wins (rule E3)",
                    self.name(*primitive)
                );
                line(f, "behind", &text)?;
            }
            Some(Next {
                primitive,
                z,
                farther,
                ..
            }) => {
                let farther = if *farther < 1e-4 {
                    format!("{farther:e}")
                } else {
                    farther.to_string()
                };
                line(
                    f,
                    "behind",
                    &format!(
                        "{}, Z about {}: {farther} farther",
                        self.name(*primitive),
                        z.low
                    ),
                )?;
            }
            None if scan.first.is_some() => line(f, "behind", "nothing")?,
            None => {}
        }
        if let Some(missed) = &scan.missed {
            let text = format!(
                "{}, {} pixels away on the film",
                self.name(missed.primitive),
                missed.on_film
            );
            line(f, "nearest", &text)?;
        }
        if scan.unmeasured > 0 {
            line(
                f,
                "",
                &format!(
                    "not measured: spheres, cylinders and disks, of which there are {}",
                    scan.unmeasured
                ),
            )?;
        }
        if scan.met > 1 {
            line(
                f,
                "",
                &format!("{} are met in all", counted(scan.met, "primitive")),
            )?;
        }
        Ok(())
    }

    fn tell_of_answers(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut last = None;
        for answer in &self.explanation.answers {
            let kind = answer.precision.map_or("yardsticks", Precision::name);
            let subject = if last == Some(kind) { "" } else { kind };
            last = Some(kind);
            line(f, subject, &format!("{:16}  {}", answer.way, found(answer)))?;
        }
        Ok(())
    }

    fn verdict(&self) -> String {
        let count = self.scene.geometry.primitive_count();
        let Explanation {
            is_judged,
            contradictions,
            ..
        } = self.explanation;
        match (contradictions.is_empty(), is_judged) {
            (false, _) => "CONTRADICTION: see the error".to_owned(),
            (true, true) => format!(
                "agrees: exact arithmetic on {}",
                counted(count, "primitive")
            ),
            (true, false) => {
                format!("not asked: it takes too long for more than {MAX_JUDGED} primitives")
            }
        }
    }

    /// A primitive by its number, and where the file has its shape.
    fn name(&self, placed: InstancedId) -> String {
        let geometry = &self.scene.geometry;
        let (prim, id) = (geometry.image_number(placed), geometry.shape_number(placed));
        let of_shape = self
            .scene
            .places
            .as_ref()
            .and_then(|places| places.shape(id));
        let of_shape = of_shape.map_or(String::new(), |(name, place)| {
            format!(": {}, {place}", printable(name))
        });
        format!("prim {prim} of shape {id}{of_shape}")
    }
}

fn margin(margin: &Margin) -> String {
    let on_rim = margin.is_on_rim();
    match margin {
        Margin::Triangle {
            barycentric,
            on_film,
        } => {
            let on_film = on_film.map_or(String::new(), |pixels| {
                format!("; {pixels} pixels from the nearest edge on the film")
            });
            let rim = if on_rim {
                "; exactly on its edge, which counts as hit (rule E1)"
            } else {
                ""
            };
            format!(
                "barycentric {}, where 0 would be on an edge{on_film}{rim}",
                triple(*barycentric)
            )
        }
        Margin::Quadric { .. } if on_rim => {
            "the ray touches it exactly, which counts as hit (rules E2 and E5)".to_owned()
        }
        Margin::Quadric {
            clearance: Some(clearance),
        } => {
            format!(
                "(b^2 - ac) / b^2 of its equation is {clearance}: 0 would be a ray that touches it"
            )
        }
        Margin::Quadric { clearance: None } => "not measured".to_owned(),
    }
}

fn found(answer: &Answer) -> String {
    let Some(Found {
        prim,
        instance,
        z,
        t,
    }) = answer.found
    else {
        return "miss".to_owned();
    };
    let instance = if instance > 0 {
        format!(" in instance {instance}")
    } else {
        String::new()
    };
    let off = match answer.ulps {
        Some([of_z, of_t]) if answer.precision != Some(Precision::Exact) => {
            format!(": off by {of_z} and {of_t} ulps")
        }
        _ => String::new(),
    };
    format!("prim {prim}{instance}, Z {z}, t {t}{off}")
}

fn triple([x, y, z]: [f64; 3]) -> String {
    format!("({x}, {y}, {z})")
}
