//! Triangle meshes: PLY, OBJ, STL and OFF files, compressed or not; subdivision surfaces, bilinear
//! patches, NURBS surfaces and height fields.
//!
//! A mesh keeps the order of its file: faces in file order, and the triangles of a face in the
//! order that [`polygon`] fixes. The index of a triangle is the primitive id that images store.
//!
//! Numbers follow rule R1 of `docs/accuracy.md`.

pub mod bilinear_patch;
pub mod curve;
mod faces;
mod flat_polygon;
mod format;
mod grid;
pub mod height_field;
mod lexer;
pub mod loop_subdivision;
pub mod nurbs;
mod obj;
mod off;
mod ply;
pub mod polygon;
mod quote;
mod stl;
mod tally;
#[cfg(test)]
mod tests;
mod triangle_mesh;

pub use format::MeshFormat;
pub use triangle_mesh::{CornerWants, Loaded, TriangleMesh, of_corners};

use std::path::Path;

use crate::error::Result;
use crate::input::{self, Budget, gzip, without_utf8_mark};

/// Reads the mesh file `path`, with what `wants` says. The content decides on the format; `named`
/// is the format of a file that no first bytes identify.
pub fn read(path: &Path, named: MeshFormat, wants: CornerWants) -> Result<Loaded> {
    read_within(path, named, wants, &Budget::default())
}

/// Like [`read`], for a scene with this `budget`.
pub(crate) fn read_within(
    path: &Path,
    named: MeshFormat,
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    budget.enter(path);
    if named == MeshFormat::Ply {
        let storage = input::Storage::open(path);
        let read = |storage: input::Storage| ply::read_fast(path, &storage, wants, budget);
        if let Some(loaded) = storage.and_then(read) {
            return Ok(loaded);
        }
    }
    parse_content(path, &input::read(path)?, named, wants, budget)
}

/// Like [`read`], for the bytes of a file; `path` is for messages only.
pub fn parse(path: &Path, bytes: &[u8], named: MeshFormat, wants: CornerWants) -> Result<Loaded> {
    let budget = &Budget::of_bytes(bytes.len());
    if named == MeshFormat::Ply {
        let fast = ply::read_fast(path, &input::Storage::Memory(bytes), wants, budget);
        if let Some(loaded) = fast {
            return Ok(loaded);
        }
    }
    parse_content(path, bytes, named, wants, budget)
}

/// Parses the bytes of any mesh file, compressed or not.
fn parse_content(
    path: &Path,
    bytes: &[u8],
    named: MeshFormat,
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    let is_whole = !gzip::is_in(&input::Storage::Memory(bytes));
    let is_refused = is_whole && named == MeshFormat::Ply;
    gzip::parsed(path, bytes, budget, |content| {
        match format_of(content).unwrap_or(named) {
            MeshFormat::Ply => ply::parse(path, content, is_refused, wants, budget),
            MeshFormat::Obj => obj::parse(path, content, wants, budget),
            MeshFormat::Stl => stl::parse(path, content, budget),
            MeshFormat::Off => off::parse(path, content, wants, budget),
        }
    })
}

/// The format of a file with this content; `None` if its first bytes tell nothing, as in OBJ.
fn format_of(content: &[u8]) -> Option<MeshFormat> {
    let text = without_utf8_mark(content);
    if text.starts_with(b"ply\n") || text.starts_with(b"ply\r") {
        Some(MeshFormat::Ply)
    } else if off::recognises(text) {
        Some(MeshFormat::Off)
    } else {
        stl::recognises(content).then_some(MeshFormat::Stl)
    }
}

/// Reads the mesh file `path`, a PLY file unless its first bytes say otherwise.
pub fn read_ply(path: &Path) -> Result<Loaded> {
    read(path, MeshFormat::Ply, CornerWants::NOTHING)
}

/// Reads the mesh file `path`, an OBJ file unless its first bytes say otherwise. Material libraries
/// that it names are not opened.
pub fn read_obj(path: &Path) -> Result<Loaded> {
    read(path, MeshFormat::Obj, CornerWants::NOTHING)
}

/// Like [`read_ply`], for the bytes of a file; `path` is for messages only.
pub fn parse_ply(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    parse(path, bytes, MeshFormat::Ply, CornerWants::NOTHING)
}

/// Like [`read_obj`], for the bytes of a file; `path` is for messages only.
pub fn parse_obj(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    parse(path, bytes, MeshFormat::Obj, CornerWants::NOTHING)
}
