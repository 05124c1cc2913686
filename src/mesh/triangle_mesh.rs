//! A triangle mesh, and the result of reading one.

use std::path::Path;

use crate::parallel::CollectVec;
use rayon::prelude::*;

use crate::error::{Diagnostic, SourceLocation, counted};
use crate::geometry::Point;
use crate::shape::{CornerNormals, CornerUv};

/// The geometry of one file, in object space.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriangleMesh {
    /// The corners. Triangles with a corner that is not finite are never hit.
    pub vertices: Vec<Point>,
    /// Three indices of `vertices` each, in the order of the file.
    pub triangles: Vec<[u32; 3]>,
    /// u and v at the corners of each, if they are wanted and the file has them.
    pub uv: Option<Vec<CornerUv>>,
    /// Vertex normals likewise.
    pub normals: Option<Vec<CornerNormals>>,
}

impl TriangleMesh {
    /// The memory that it takes, in bytes.
    pub(crate) fn bytes(&self) -> u64 {
        let uv = self.uv.as_deref().map_or(0, size_of_val);
        let normals = self.normals.as_deref().map_or(0, size_of_val);
        let corners = uv + normals;
        (size_of_val(&self.vertices[..]) + size_of_val(&self.triangles[..]) + corners) as u64
    }
}

/// A mesh, and warnings about its file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Loaded {
    /// The geometry.
    pub mesh: TriangleMesh,
    /// Warnings for the user. A repeated one is counted and names the first place.
    pub warnings: Vec<Diagnostic>,
}

impl Loaded {
    /// Adds the warnings that all formats have in common.
    pub(crate) fn new(path: &Path, mesh: TriangleMesh, mut warnings: Vec<Diagnostic>) -> Loaded {
        let broken_of = |chunk: &[Point]| chunk.iter().filter(|vertex| !vertex.is_finite()).count();
        let broken: usize = mesh.vertices.par_chunks(1 << 12).map(broken_of).sum();
        if broken > 0 && !mesh.triangles.is_empty() {
            let message = format!(
                "{} with an infinite or NaN coordinate",
                counted(broken as u64, "vertex")
            );
            let warning = Diagnostic::new(message).at(SourceLocation::file(path));
            warnings.push(warning.note("triangles that use such a vertex are never hit"));
        }
        if mesh.triangles.is_empty() {
            warnings.push(empty(path, mesh.vertices.len()));
        }
        Loaded { mesh, warnings }
    }
}

/// What to read of a mesh besides its triangles. Wanting more takes slower readers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct CornerWants {
    /// [`TriangleMesh::uv`].
    pub uv: bool,
    /// [`TriangleMesh::normals`].
    pub normals: bool,
}

impl CornerWants {
    /// All that meshes have.
    pub const EVERYTHING: CornerWants = CornerWants {
        uv: true,
        normals: true,
    };
    /// Only the triangles.
    pub const NOTHING: CornerWants = CornerWants {
        uv: false,
        normals: false,
    };
}

/// The values at the corners of `triangles` whose vertices have `values`.
pub fn of_corners<T: Copy + Send + Sync>(triangles: &[[u32; 3]], values: &[T]) -> Vec<[T; 3]> {
    triangles
        .par_iter()
        .map(|corners| corners.map(|corner| values[corner as usize]))
        .collect_vec()
}

fn empty(path: &Path, vertices: usize) -> Diagnostic {
    let message = match vertices {
        0 => "the mesh is empty: it has no faces".to_string(),
        _ => format!(
            "the mesh has no faces, only {}",
            counted(vertices as u64, "vertex")
        ),
    };
    Diagnostic::new(message)
        .at(SourceLocation::file(path))
        .note("rays cannot hit it")
}
