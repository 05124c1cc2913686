//! `Shape "trianglemesh"`.

use super::arrays::{faces_of, uv_of, vertices_of};
use crate::error::Result;
use crate::mesh::{TriangleMesh, uv_of_corners};
use crate::scene::parameters::Parameters;
use crate::scene::shape_statement::{SURFACE, ShapeTarget};

impl ShapeTarget<'_> {
    /// Adds the triangles of `P` and `indices`, with `uv` or `st` where that is wanted.
    pub(in crate::scene) fn add_triangle_mesh(&mut self, parameters: &mut Parameters) -> Result<()> {
        parameters.ignore(&SURFACE);
        let vertices = vertices_of(parameters, "a triangle mesh")?;
        let triangles = match faces_of(parameters, vertices.len(), "three a triangle")? {
            Some(triangles) => triangles,
            None if vertices.len() == 3 => vec![[0, 1, 2]],
            None => {
                let message = format!("a triangle mesh of {} vertices without `indices`", vertices.len());
                return Err(parameters.missing("indices", message).note("only a mesh of 3 vertices needs none"));
            }
        };
        let uv = if self.keeps_uv { uv_of(parameters, vertices.len())? } else { None };
        let uv = uv.map(|uv| uv_of_corners(&triangles, &uv));
        self.add_mesh(parameters, TriangleMesh { vertices, triangles, uv })
    }
}
