//! `Shape "loopsubdiv"`.

use super::arrays::{faces_of, vertices_of};
use super::target::{ShapeRefusal, ShapeResult, ShapeTarget};
use crate::mesh::loop_subdivision::{self, Place};
use crate::scene::parameters::Parameters;

/// pbrt's default.
const LEVELS: i64 = 3;

/// Adds the triangles of a subdivision surface. `levels` is pbrt-v4's name for `nlevels`.
pub(super) fn add(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    parameters.ignore(&["scheme"]);
    let most = loop_subdivision::MOST_LEVELS.into();
    let of_v3 = parameters.integer("nlevels", 0, most)?;
    let of_v4 = parameters.integer("levels", 0, most)?;
    let levels = of_v4.or(of_v3).unwrap_or(LEVELS) as u32;
    let levels_name = if of_v4.is_some() { "levels" } else { "nlevels" };
    let vertices = vertices_of(parameters, "a subdivision surface")?;
    let Some(faces) = faces_of(parameters, vertices.len(), "three a face", target.warnings)? else {
        let error = parameters.missing("indices", "a subdivision surface without faces");
        let error = error.note("expected \"integer indices\" [ ... ]");
        return Err(ShapeRefusal::shape("without indices", error));
    };
    let control = faces.len() as u64;
    let made = u128::from(control) << (2 * levels);
    let charged = target.inputs.budget().charge_faces(control, made);
    charged.map_err(|error| error.or_at(|| parameters.place_of(levels_name)))?;
    let refined = loop_subdivision::subdivide(vertices, &faces, levels);
    let mesh = refined.map_err(|refusal| match refusal.place {
        Place::Index(index) => {
            let error = parameters.error_at_number("indices", index, refusal.message);
            ShapeRefusal::shape("that is no surface", error.note(refusal.advice))
        }
        Place::Levels => parameters
            .error_at(levels_name, refusal.message)
            .note(refusal.advice)
            .into(),
    })?;
    // pbrt gives the vertices normals of their own, against the right hand of the faces, and turns
    // the faces to their side.
    target.turn_round();
    Ok(target.add_mesh(parameters, mesh)?)
}
