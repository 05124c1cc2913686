//! OBJ meshes: vertices and polygons. All objects and groups of a file are one mesh.
//!
//! Numbers are `f64`. A vertex with a fourth number is divided by it; further numbers are colours,
//! which are ignored. Vertices come in the order in which faces use them, each once; those without
//! a face are left out.

mod lexer;
mod mistakes;
mod parallel;
mod plain;
mod reader;
#[cfg(test)]
mod tests;

use std::path::Path;

use self::lexer::Statements;
use super::{CornerWants, Loaded, signature};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{Budget, gzip};

/// Reads the bytes of an OBJ file, compressed or not, with what `wants` says of its corners;
/// `path` is for messages only.
pub(super) fn parse(
    path: &Path,
    bytes: &[u8],
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    gzip::parsed(path, bytes, budget, |content| {
        let text = signature::without_utf8_mark(content);
        if let Some(found) = signature::describe(text) {
            let diagnostic = Diagnostic::new(format!("not an OBJ mesh: this is {found}"));
            return Err(Error::bad_input(diagnostic.at(SourceLocation::file(path))));
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
    })
}
