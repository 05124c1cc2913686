//! `Shape "trianglemesh"`.

use super::arrays::{faces_of, normals_of, uv_of, vertices_of};
use super::target::{SURFACE, ShapeRefusal, ShapeResult, ShapeTarget};
use crate::error::counted;
use crate::mesh::{TriangleMesh, of_corners};
use crate::scene::parameters::Parameters;

/// Adds the triangles of `P` and `indices`, with `uv` or `st`, and `N`, if the options want them.
pub(super) fn add(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    parameters.ignore(&SURFACE);
    let vertices = vertices_of(parameters, "a triangle mesh")?;
    let count = vertices.len();
    let triangles = match faces_of(parameters, count, "three a triangle", target.warnings)? {
        Some(triangles) => triangles,
        None if count == 3 => vec![[0, 1, 2]],
        None => {
            let message = format!(
                "a triangle mesh of {} without `indices`",
                counted(count as u64, "vertex")
            );
            let error = parameters.missing("indices", message);
            let error = error.note("only a mesh of 3 vertices needs none");
            return Err(ShapeRefusal::shape("without indices", error));
        }
    };
    let uv = match target.keeps_uv {
        true => uv_of(parameters, count, target.warnings)?,
        false => None,
    };
    let normals = match target.options.orientation {
        true => normals_of(parameters, count, target.warnings)?,
        false => None,
    };
    let uv = uv.map(|uv| of_corners(&triangles, &uv));
    let normals = normals.map(|normals| of_corners(&triangles, &normals));
    Ok(target.add_mesh(
        parameters,
        TriangleMesh {
            vertices,
            triangles,
            uv,
            normals,
        },
    )?)
}
