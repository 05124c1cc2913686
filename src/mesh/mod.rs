//! Mesh files: PLY and OBJ, plain or gzipped, to triangles in object space.

mod file;
mod obj;
mod ply;
mod polygon;

use crate::error::{Diagnostic, Result, SourceLocation};
use crate::geometry::Point;
use std::path::Path;

/// The geometry of one file in object space.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriangleMesh {
    /// The corners, as the file has them: some may be infinite or NaN.
    pub vertices: Vec<Point>,
    /// Indices of three vertices each, all in range; faces in the order of the file (rule E3).
    pub triangles: Vec<[u32; 3]>,
}

/// A mesh and what its reader has to say about it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Loaded {
    /// The geometry.
    pub mesh: TriangleMesh,
    /// What was left out or will never be hit.
    pub warnings: Vec<Diagnostic>,
}

/// Reads a PLY file: ASCII or binary, gzipped or not.
pub fn read_ply(path: &Path) -> Result<Loaded> {
    parse_ply(path, &file::read(path)?)
}

/// Reads a Wavefront OBJ file, gzipped or not.
pub fn read_obj(path: &Path) -> Result<Loaded> {
    parse_obj(path, &file::read(path)?)
}

/// Reads the PLY file in `bytes`; `path` is for messages.
pub fn parse_ply(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    Ok(with_common_warnings(path, ply::parse(path, bytes)?))
}

/// Reads the OBJ file in `bytes`; `path` is for messages.
pub fn parse_obj(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    Ok(with_common_warnings(path, obj::parse(path, bytes)?))
}

fn with_common_warnings(path: &Path, mut loaded: Loaded) -> Loaded {
    let TriangleMesh { vertices, triangles } = &loaded.mesh;
    let mut warn = |message: String| {
        loaded.warnings.push(Diagnostic::new(message).at(SourceLocation::file(path)));
    };
    if triangles.is_empty() {
        warn(format!("the mesh has {} vertices and no faces: there is nothing to hit", vertices.len()));
    }
    let lost = vertices.iter().filter(|vertex| !vertex.is_finite()).count();
    if lost > 0 {
        let of = vertices.len();
        warn(format!("{lost} of {of} vertices are infinite or not a number: their triangles are never hit"));
    }
    loaded
}
