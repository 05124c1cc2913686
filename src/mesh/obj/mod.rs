//! OBJ meshes: vertices and polygons. All objects and groups of a file are one mesh.
//!
//! Numbers are `f64`. A vertex with a fourth number is divided by it; further numbers are colours,
//! which are ignored. Vertices come in the order in which faces use them, each once; those without
//! a face are left out.

mod mistakes;
mod parallel;
mod plain;
mod reader;
#[cfg(test)]
mod tests;

use std::path::Path;

use super::lexer::Statements;
use super::{CornerWants, Loaded, MeshFormat};
use crate::error::Result;
use crate::input::{Budget, without_utf8_mark};

/// Parses the content of an OBJ file, with what `wants` says of its corners; `path` is for messages
/// only.
pub(super) fn parse(
    path: &Path,
    content: &[u8],
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    let text = without_utf8_mark(content);
    if let Some(error) = MeshFormat::Obj.refused(path, text) {
        return Err(error);
    }
    let has =
        |keyword: &[u8]| Statements::new(text).any(|statement| statement.keyword() == keyword);
    let found = CornerWants {
        uv: wants.uv && has(b"vt"),
        normals: wants.normals && has(b"vn"),
    };
    if found != CornerWants::NOTHING {
        return reader::read(path, text, found, budget);
    }
    match parallel::read(text, budget) {
        Some(mesh) => Ok(Loaded::new(path, mesh, Vec::new())),
        None => reader::read(path, text, CornerWants::NOTHING, budget),
    }
}
