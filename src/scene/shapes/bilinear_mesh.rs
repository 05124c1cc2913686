//! `Shape "bilinearmesh"` of pbrt-v4.

use super::arrays::{faces_of, uv_of, vertices_of};
use crate::error::Diagnostic;
use crate::mesh::{TriangleMesh, bilinear_patch, uv_of_corners};
use crate::scene::parameters::Parameters;
use crate::scene::shape_refusal::{ShapeRefusal, ShapeResult};
use crate::scene::shape_statement::{SURFACE, ShapeTarget};
use rayon::prelude::*;

impl ShapeTarget<'_> {
    /// Adds two triangles for each patch (rule R7): the same points where the patch is flat and convex, else near it.
    pub(in crate::scene) fn add_bilinear_mesh(
        &mut self,
        parameters: &mut Parameters,
    ) -> ShapeResult<()> {
        parameters.ignore(&SURFACE);
        let vertices = vertices_of(parameters, "a bilinear mesh")?;
        let patches = match faces_of(parameters, vertices.len(), "four a patch", self.warnings)? {
            Some(patches) => patches,
            None if vertices.len() == 4 => vec![[0, 1, 2, 3]],
            None => {
                let message = format!(
                    "a bilinear mesh of {} vertices without `indices`",
                    vertices.len()
                );
                let error = parameters.missing("indices", message);
                let error = error.note("only a single patch, of 4 vertices, needs none");
                return Err(ShapeRefusal::shape("without indices", error));
            }
        };
        let is_curved = |patch: &[u32; 4]| {
            !bilinear_patch::is_flat_and_convex(patch.map(|corner| vertices[corner as usize]))
        };
        if patches.par_iter().any(is_curved) {
            let message =
                "bilinear patches that are not flat and convex are rendered as two triangles each";
            let note = "for a closer surface, give it as a finer `trianglemesh`";
            parameters.warn_at_name(
                "curved patches",
                Diagnostic::new(message).note(note),
                self.warnings,
            );
        }
        let triangles: Vec<[[u32; 3]; 2]> = patches
            .par_iter()
            .map(|patch| bilinear_patch::triangles(*patch))
            .collect();
        let triangles = triangles.into_flattened();
        let uv = match self.keeps_uv {
            true => Some(uv_of(parameters, vertices.len(), self.warnings)?),
            false => None,
        };
        let uv = uv.map(|uv| match uv {
            Some(uv) => uv_of_corners(&triangles, &uv),
            None => vec![bilinear_patch::UV; triangles.len() / 2].into_flattened(),
        });
        Ok(self.add_mesh(
            parameters,
            TriangleMesh {
                vertices,
                triangles,
                uv,
            },
        )?)
    }
}
