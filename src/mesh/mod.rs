//! Meshes as triangles: files in PLY and OBJ, either of them compressed with gzip; subdivision surfaces and bilinear patches.
//!
//! A mesh keeps the order of its file: faces in file order, and the triangles of a face in the order that
//! [`polygon`] fixes, because a triangle's place is the primitive id that pictures store.
//!
//! Numbers follow rule R1 of `docs/accuracy.md`.

pub mod bilinear_patch;
mod faces;
pub mod loop_subdivision;
mod obj;
mod ply;
pub mod polygon;
mod quote;
mod signature;
mod tally;
#[cfg(test)]
mod tests;

use std::path::Path;

use rayon::prelude::*;

use crate::error::{Diagnostic, Result, SourceLocation};
use crate::geometry::Point;
use crate::input::{self, Budget};
use crate::shape::CornerUv;

/// The geometry of one file, in object space.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriangleMesh {
    /// The corners; not finite where the file says so, which makes its triangles ones that are never hit.
    pub vertices: Vec<Point>,
    /// Three places in `vertices` each, in the order of the file.
    pub triangles: Vec<[u32; 3]>,
    /// u and v at the corners of each, where they were wanted and the file has some.
    pub uv: Option<Vec<CornerUv>>,
}

impl TriangleMesh {
    /// Bytes that it takes.
    pub(crate) fn bytes(&self) -> u64 {
        let uv = self.uv.as_deref().map_or(0, size_of_val);
        (size_of_val(&self.vertices[..]) + size_of_val(&self.triangles[..]) + uv) as u64
    }
}

/// A mesh, and what is odd about the file without making it unusable.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Loaded {
    /// The geometry.
    pub mesh: TriangleMesh,
    /// To be shown to the user; a repeated oddity is counted and told once, at its first place.
    pub warnings: Vec<Diagnostic>,
}

/// The formats of mesh files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MeshFormat {
    /// By the Stanford 3D Scanning Repository.
    Ply,
    /// By Wavefront.
    Obj,
}

/// Reads the mesh file `path`. Where `with_uv` says so, that is with the coordinates of the surface, if it has some: these take the
/// slower readers.
pub fn read(path: &Path, format: MeshFormat, with_uv: bool) -> Result<Loaded> {
    read_within(path, format, with_uv, &Budget::default())
}

/// As [`read`], for a scene with this `budget`.
pub(crate) fn read_within(
    path: &Path,
    format: MeshFormat,
    with_uv: bool,
    budget: &Budget,
) -> Result<Loaded> {
    budget.enter(path);
    if (format, with_uv) == (MeshFormat::Ply, false) {
        let storage = input::Storage::open(path);
        if let Some(loaded) = storage.and_then(|storage| ply::read_fast(path, &storage, budget)) {
            return Ok(loaded);
        }
        return ply::parse(path, &input::read(path)?, budget);
    }
    parse_within(path, &input::read(path)?, format, with_uv, budget)
}

/// As [`read`], of the bytes of a file; `path` is for messages only.
pub fn parse(path: &Path, bytes: &[u8], format: MeshFormat, with_uv: bool) -> Result<Loaded> {
    parse_within(path, bytes, format, with_uv, &Budget::of_bytes(bytes.len()))
}

fn parse_within(
    path: &Path,
    bytes: &[u8],
    format: MeshFormat,
    with_uv: bool,
    budget: &Budget,
) -> Result<Loaded> {
    match (format, with_uv) {
        (MeshFormat::Ply, false) => {
            let fast = ply::read_fast(path, &input::Storage::Memory(bytes), budget);
            fast.map_or_else(|| ply::parse(path, bytes, budget), Ok)
        }
        (MeshFormat::Obj, with_uv) => obj::parse(path, bytes, with_uv, budget),
        (MeshFormat::Ply, true) => ply::parse_with_uv(path, bytes, budget),
    }
}

/// Reads the PLY file `path`.
pub fn read_ply(path: &Path) -> Result<Loaded> {
    read(path, MeshFormat::Ply, false)
}

/// Reads the OBJ file `path`. Material libraries that it names are not opened.
pub fn read_obj(path: &Path) -> Result<Loaded> {
    read(path, MeshFormat::Obj, false)
}

/// Reads the bytes of a PLY file, compressed or not; `path` is for messages only.
pub fn parse_ply(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    parse(path, bytes, MeshFormat::Ply, false)
}

/// Reads the bytes of an OBJ file, compressed or not; `path` is for messages only.
pub fn parse_obj(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    parse(path, bytes, MeshFormat::Obj, false)
}

impl Loaded {
    /// Adds the warnings that any format can give rise to.
    fn new(path: &Path, mesh: TriangleMesh, mut warnings: Vec<Diagnostic>) -> Loaded {
        let broken = mesh
            .vertices
            .par_iter()
            .filter(|vertex| !vertex.is_finite())
            .count();
        if broken > 0 && !mesh.triangles.is_empty() {
            let message = format!(
                "{} with an infinite or NaN coordinate",
                tally::counted(broken as u64, "vertex")
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

/// What the corners of `triangles` have where vertices have `uv`.
pub fn uv_of_corners(triangles: &[[u32; 3]], uv: &[[f32; 2]]) -> Vec<CornerUv> {
    triangles
        .par_iter()
        .map(|corners| corners.map(|corner| uv[corner as usize]))
        .collect()
}

fn empty(path: &Path, vertices: usize) -> Diagnostic {
    let message = match vertices {
        0 => "the mesh is empty: it has no faces".to_string(),
        _ => format!(
            "the mesh has no faces, only {}",
            tally::counted(vertices as u64, "vertex")
        ),
    };
    Diagnostic::new(message)
        .at(SourceLocation::file(path))
        .note("nothing of it can be hit")
}
