//! Triangle meshes: PLY and OBJ files, compressed or not; subdivision surfaces, bilinear patches,
//! NURBS surfaces and height fields.
//!
//! A mesh keeps the order of its file: faces in file order, and the triangles of a face in the
//! order that [`polygon`] fixes. The index of a triangle is the primitive id that images store.
//!
//! Numbers follow rule R1 of `docs/accuracy.md`.

pub mod bilinear_patch;
pub mod curve;
mod faces;
mod flat_polygon;
mod grid;
pub mod height_field;
pub mod loop_subdivision;
pub mod nurbs;
mod obj;
mod ply;
pub mod polygon;
mod quote;
mod signature;
mod tally;
#[cfg(test)]
mod tests;
mod triangle_mesh;

pub use triangle_mesh::{CornerWants, Loaded, TriangleMesh, of_corners};

use std::path::Path;

use crate::error::Result;
use crate::input::{self, Budget};

/// The formats of mesh files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MeshFormat {
    /// PLY, of the Stanford 3D Scanning Repository.
    Ply,
    /// OBJ, of Wavefront.
    Obj,
}

/// Reads the mesh file `path`, with what `wants` says.
pub fn read(path: &Path, format: MeshFormat, wants: CornerWants) -> Result<Loaded> {
    read_within(path, format, wants, &Budget::default())
}

/// Like [`read`], for a scene with this `budget`.
pub(crate) fn read_within(
    path: &Path,
    format: MeshFormat,
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    budget.enter(path);
    if (format, wants) == (MeshFormat::Ply, CornerWants::NOTHING) {
        let storage = input::Storage::open(path);
        if let Some(loaded) = storage.and_then(|storage| ply::read_fast(path, &storage, budget)) {
            return Ok(loaded);
        }
        return ply::parse(path, &input::read(path)?, budget);
    }
    parse_within(path, &input::read(path)?, format, wants, budget)
}

/// Like [`read`], for the bytes of a file; `path` is for messages only.
pub fn parse(path: &Path, bytes: &[u8], format: MeshFormat, wants: CornerWants) -> Result<Loaded> {
    parse_within(path, bytes, format, wants, &Budget::of_bytes(bytes.len()))
}

fn parse_within(
    path: &Path,
    bytes: &[u8],
    format: MeshFormat,
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    match (format, wants) {
        (MeshFormat::Ply, CornerWants::NOTHING) => {
            let fast = ply::read_fast(path, &input::Storage::Memory(bytes), budget);
            fast.map_or_else(|| ply::parse(path, bytes, budget), Ok)
        }
        (MeshFormat::Obj, wants) => obj::parse(path, bytes, wants, budget),
        (MeshFormat::Ply, wants) => ply::parse_with_corners(path, bytes, wants, budget),
    }
}

/// Reads the PLY file `path`.
pub fn read_ply(path: &Path) -> Result<Loaded> {
    read(path, MeshFormat::Ply, CornerWants::NOTHING)
}

/// Reads the OBJ file `path`. Material libraries that it names are not opened.
pub fn read_obj(path: &Path) -> Result<Loaded> {
    read(path, MeshFormat::Obj, CornerWants::NOTHING)
}

/// Reads the bytes of a PLY file, compressed or not; `path` is for messages only.
pub fn parse_ply(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    parse(path, bytes, MeshFormat::Ply, CornerWants::NOTHING)
}

/// Reads the bytes of an OBJ file, compressed or not; `path` is for messages only.
pub fn parse_obj(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    parse(path, bytes, MeshFormat::Obj, CornerWants::NOTHING)
}
