//! `Shape "plymesh"` and `Shape "objmesh"`: meshes in files of their own.

use super::target::{SURFACE, ShapeResult, ShapeTarget};
use crate::input::advise_beside;
use crate::mesh::MeshFormat;
use crate::scene::parameters::Parameters;

/// Adds the triangles of a mesh file: PLY, unless its content says otherwise.
pub(super) fn add_ply(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    add(parameters, target, MeshFormat::Ply)
}

/// Adds the triangles of a mesh file: OBJ, unless its content says otherwise.
pub(super) fn add_obj(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    add(parameters, target, MeshFormat::Obj)
}

fn add(
    parameters: &mut Parameters,
    target: &mut ShapeTarget,
    format: MeshFormat,
) -> ShapeResult<()> {
    parameters.ignore(&SURFACE);
    let Some(filename) = parameters.path("filename")? else {
        let error = parameters.missing("filename", "a mesh without a file name");
        return Err(error
            .note("expected \"string filename\" \"mesh.ply\"")
            .into());
    };
    let path = target.inputs.resolve(&filename);
    let wants = target.corners();
    let read = target.inputs.read_mesh(&path, format, wants);
    let loaded = read.map_err(|error| {
        let place = parameters.place_of("filename");
        advise_beside(&place.path, &filename, &path, error).note(format!("named in {place}"))
    })?;
    for warning in loaded.warnings {
        let kind = warning.to_string();
        let named_in = || format!("named in {}", parameters.place_of("filename"));
        target.warnings.add(kind, || warning.note(named_in()));
    }
    Ok(target.add_mesh(parameters, loaded.mesh)?)
}
