//! `Shape "trianglemesh"`.

use super::arrays::{faces_of, uv_of, vertices_of};
use crate::mesh::{TriangleMesh, uv_of_corners};
use crate::scene::parameters::Parameters;
use crate::scene::shape_refusal::{ShapeRefusal, ShapeResult};
use crate::scene::shape_statement::{SURFACE, ShapeTarget};

impl ShapeTarget<'_> {
    /// Adds the triangles of `P` and `indices`, with `uv` or `st` where that is wanted.
    pub(in crate::scene) fn add_triangle_mesh(
        &mut self,
        parameters: &mut Parameters,
    ) -> ShapeResult<()> {
        parameters.ignore(&SURFACE);
        let vertices = vertices_of(parameters, "a triangle mesh")?;
        let triangles = match faces_of(
            parameters,
            vertices.len(),
            "three a triangle",
            self.warnings,
        )? {
            Some(triangles) => triangles,
            None if vertices.len() == 3 => vec![[0, 1, 2]],
            None => {
                let message = format!(
                    "a triangle mesh of {} vertices without `indices`",
                    vertices.len()
                );
                let error = parameters
                    .missing("indices", message)
                    .note("only a mesh of 3 vertices needs none");
                return Err(ShapeRefusal::shape("without indices", error));
            }
        };
        let uv = if self.keeps_uv {
            uv_of(parameters, vertices.len(), self.warnings)?
        } else {
            None
        };
        let uv = uv.map(|uv| uv_of_corners(&triangles, &uv));
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
