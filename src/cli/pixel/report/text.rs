//! The report on a pixel as text.

use super::{AnswerLine, BASELINE, Behind, Cost, Cut, Hit, NearestMissed, PrimitiveName, Report};
use crate::accel::Precision;
use crate::cli::terminal::words::{counted, line, lines};
use crate::error::printable;
use crate::pixel::{MAX_REFERENCED, MAX_SCANNED};
use std::fmt::{self, Display, Formatter};

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
        if let Some(cut) = &self.cut {
            line(f, "cut away", &cut.to_string())?;
        }
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
                "the ray touches it exactly, which counts as hit (rules E2, E5 and E8 to E10)"
                    .to_owned()
            }
            Some(clearance) => format!(
                "(b^2 - ac) / b^2 of its equation is {clearance}: 0 would be a ray that touches it"
            ),
            None => "not measured".to_owned(),
        }
    }
}

impl Display for Cut<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Cut {
            primitive,
            z,
            u,
            v,
            alpha,
        } = self;
        write!(
            f,
            "{primitive}, Z about {z}: its alpha is {alpha} at u {u}, v {v} (rule A1)"
        )
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
