//! Triangles that share no vertices.

use std::path::Path;

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::Point;
use crate::memory;
use crate::mesh::faces::check_count;
use crate::mesh::{Loaded, TriangleMesh};
use crate::parallel::CollectVec;
use rayon::prelude::*;

/// The mesh whose triangles have these vertices, three each.
pub(super) fn mesh_of(
    path: &Path,
    vertices: Vec<Point>,
    warnings: Vec<Diagnostic>,
) -> Result<Loaded> {
    let at_file = |error: Error| error.or_at(|| SourceLocation::file(path));
    check_count(vertices.len() as u64, "vertices").map_err(at_file)?;
    let count = vertices.len() / 3;
    let too_large = || format!("{count} triangles are too many for this machine's memory");
    memory::check((count * size_of::<[u32; 3]>()) as u64, too_large).map_err(at_file)?;
    let corners = |triangle: u32| [0, 1, 2].map(|corner| 3 * triangle + corner);
    let mesh = TriangleMesh {
        vertices,
        triangles: (0..count as u32).into_par_iter().map(corners).collect_vec(),
        ..TriangleMesh::default()
    };
    Ok(Loaded::new(path, mesh, warnings))
}
