//! `Shape "loopsubdiv"`.

use super::arrays::{faces_of, vertices_of};
use crate::mesh::loop_subdivision::{self, Place, Refusal};
use crate::scene::parameters::Parameters;
use crate::scene::shape_refusal::{ShapeRefusal, ShapeResult};
use crate::scene::shape_statement::ShapeTarget;

/// What pbrt takes where a scene does not say.
const LEVELS: i64 = 3;

impl ShapeTarget<'_> {
    /// Adds the triangles of a subdivision surface. `levels` is pbrt-v4's name for `nlevels`.
    pub(in crate::scene) fn add_subdivision_surface(
        &mut self,
        parameters: &mut Parameters,
    ) -> ShapeResult<()> {
        parameters.ignore(&["scheme"]);
        let most = loop_subdivision::MOST_LEVELS.into();
        let of_v3 = parameters.integer("nlevels", 0, most)?;
        let of_v4 = parameters.integer("levels", 0, most)?;
        let levels = of_v4.or(of_v3).unwrap_or(LEVELS) as u32;
        let vertices = vertices_of(parameters, "a subdivision surface")?;
        let Some(faces) = faces_of(parameters, vertices.len(), "three a face", self.warnings)?
        else {
            let message = "a subdivision surface without faces";
            let error = parameters
                .missing("indices", message)
                .note("expected \"integer indices\" [ ... ]");
            return Err(ShapeRefusal::shape("without indices", error));
        };
        let control = faces.len() as u64;
        let made = u128::from(control) << (2 * levels);
        self.budget.charge_faces(control, made).map_err(|error| {
            error.or_at(|| parameters.place_of(if of_v4.is_some() { "levels" } else { "nlevels" }))
        })?;
        let refined = loop_subdivision::subdivide(vertices, &faces, levels);
        let mesh = refined.map_err(
            |Refusal {
                 place,
                 message,
                 advice,
             }| {
                let levels = if of_v4.is_some() { "levels" } else { "nlevels" };
                match place {
                    Place::Index(place) => {
                        let error = parameters
                            .error_at_number("indices", place, message)
                            .note(advice);
                        ShapeRefusal::shape("that is no surface", error)
                    }
                    Place::Levels => parameters.error_at(levels, message).note(advice).into(),
                }
            },
        )?;
        // pbrt gives the vertices normals of their own, against the right hand of the faces, and
        // turns the faces to their side.
        self.turn_round();
        Ok(self.add_mesh(parameters, mesh)?)
    }
}
