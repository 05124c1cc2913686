//! STL meshes: triangles with three vertices each, as bytes or as text.
//!
//! A vertex that triangles share stands in the file once for each of them, and is stored as often:
//! merging equal vertices would take a search and would change no image. The normals of the file
//! are ignored; the order of the corners decides on the side, as everywhere.

mod binary;
mod text;

use std::path::Path;

use super::faces::check_count;
use super::{Loaded, MeshFormat, TriangleMesh};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::Point;
use crate::input::without_utf8_mark;
use crate::memory;
use rayon::prelude::*;

/// The first bytes that tell text from binary data.
const HEAD: usize = 1024;

/// Whether `content` is surely an STL file. A binary one is told by its size, since programs write
/// anything into its first bytes, even `solid`.
pub(super) fn recognises(content: &[u8]) -> bool {
    binary::has_exact_size(content) || text::begins(without_utf8_mark(content))
}

/// Parses the content of an STL file; `path` is for messages only.
pub(super) fn parse(path: &Path, content: &[u8]) -> Result<Loaded> {
    let is_text = !content[..content.len().min(HEAD)].contains(&0);
    if binary::has_exact_size(content) || !is_text {
        if let Some(error) = refused(path, content) {
            return Err(error);
        }
        return binary::read(path, content);
    }
    let text = without_utf8_mark(content);
    if text::begins(text) {
        return text::read(path, text);
    }
    Err(refused(path, content).unwrap_or_else(|| {
        let diagnostic = Diagnostic::new("not an STL mesh").at(SourceLocation::file(path));
        Error::bad_input(diagnostic.note("expected `solid` as the first word, or binary data"))
    }))
}

/// The error about a file of another kind; but no binary STL is one, whatever its header says.
fn refused(path: &Path, content: &[u8]) -> Option<Error> {
    match binary::has_exact_size(content) {
        true => None,
        false => MeshFormat::Stl.refused(path, content),
    }
}

/// The mesh whose triangles have these vertices, three each.
fn mesh_of(path: &Path, vertices: Vec<Point>, warnings: Vec<Diagnostic>) -> Result<Loaded> {
    let at_file = |error: Error| error.or_at(|| SourceLocation::file(path));
    check_count(vertices.len() as u64, "vertices").map_err(at_file)?;
    let count = vertices.len() / 3;
    let too_large = || format!("{count} triangles are too many for this machine's memory");
    memory::check((count * size_of::<[u32; 3]>()) as u64, too_large).map_err(at_file)?;
    let corners = |triangle: u32| [0, 1, 2].map(|corner| 3 * triangle + corner);
    let mesh = TriangleMesh {
        vertices,
        triangles: (0..count as u32).into_par_iter().map(corners).collect(),
        ..TriangleMesh::default()
    };
    Ok(Loaded::new(path, mesh, warnings))
}
