//! `Shape "loopsubdiv"`.

use super::arrays::{faces_of, vertices_of};
use crate::error::Result;
use crate::mesh::loop_subdivision::{self, Place, Refusal};
use crate::scene::parameters::Parameters;
use crate::scene::shape_statement::ShapeTarget;

/// What pbrt takes where a scene does not say.
const LEVELS: i64 = 3;

impl ShapeTarget<'_> {
    /// Adds the triangles of a subdivision surface. `levels` is pbrt-v4's name for `nlevels`.
    pub(in crate::scene) fn add_subdivision_surface(&mut self, parameters: &mut Parameters) -> Result<()> {
        parameters.ignore(&["scheme"]);
        let most = loop_subdivision::MOST_LEVELS.into();
        let of_v3 = parameters.integer("nlevels", 0, most)?;
        let of_v4 = parameters.integer("levels", 0, most)?;
        let levels = of_v4.or(of_v3).unwrap_or(LEVELS) as u32;
        let vertices = vertices_of(parameters, "a subdivision surface")?;
        let Some(faces) = faces_of(parameters, vertices.len(), "three a face")? else {
            let message = "a subdivision surface without faces";
            return Err(parameters.missing("indices", message).note("expected \"integer indices\" [ ... ]"));
        };
        let refined = loop_subdivision::subdivide(vertices, &faces, levels);
        let mesh = refined.map_err(|Refusal { place, message, advice }| {
            let error = match place {
                Place::Index(place) => parameters.error_at_number("indices", place, message),
                Place::Levels if of_v4.is_some() => parameters.error_at("levels", message),
                Place::Levels => parameters.error_at("nlevels", message),
            };
            error.note(advice)
        })?;
        // pbrt gives the vertices normals of their own, against the right hand of the faces, and
        // turns the faces to their side.
        self.turn_round();
        self.add_mesh(parameters, mesh)
    }
}
