//! `Shape "bilinearmesh"` of pbrt-v4.

use super::arrays::{faces_of, uv_of, vertices_of};
use super::target::{SURFACE, ShapeRefusal, ShapeResult, ShapeTarget};
use crate::error::Diagnostic;
use crate::mesh::{TriangleMesh, bilinear_patch, of_corners};
use crate::scene::parameters::Parameters;
use rayon::prelude::*;

/// Adds two triangles for each patch (rule R7): exact if the patch is flat and convex, else close
/// to it.
pub(super) fn add(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    parameters.ignore(&SURFACE);
    let vertices = vertices_of(parameters, "a bilinear mesh")?;
    let count = vertices.len();
    let patches = match faces_of(parameters, count, "four a patch", target.warnings)? {
        Some(patches) => patches,
        None if count == 4 => vec![[0, 1, 2, 3]],
        None => {
            let message = format!("a bilinear mesh of {count} vertices without `indices`");
            let error = parameters.missing("indices", message);
            let error = error.note("only a single patch, of 4 vertices, needs none");
            return Err(ShapeRefusal::shape("without indices", error));
        }
    };
    let is_curved = |patch: &[u32; 4]| {
        !bilinear_patch::is_flat_and_convex(patch.map(|corner| vertices[corner as usize]))
    };
    if patches.par_iter().any(is_curved) {
        let diagnostic = Diagnostic::new(
            "bilinear patches that are not flat and convex are rendered as two triangles each",
        );
        let note = "for a closer surface, give it as a finer `trianglemesh`";
        parameters.warn_at_name("curved patches", diagnostic.note(note), target.warnings);
    }
    let triangles = patches
        .par_iter()
        .map(|patch| bilinear_patch::triangles(*patch));
    let triangles = triangles.collect::<Vec<[[u32; 3]; 2]>>().into_flattened();
    let uv = if target.options.uv {
        Some(match uv_of(parameters, count, target.warnings)? {
            Some(uv) => of_corners(&triangles, &uv),
            None => vec![bilinear_patch::UV; triangles.len() / 2].into_flattened(),
        })
    } else {
        None
    };
    Ok(target.add_mesh(
        parameters,
        TriangleMesh {
            vertices,
            triangles,
            uv,
            ..TriangleMesh::default()
        },
    )?)
}
