//! STL meshes: triangles with three vertices each, as bytes or as text.
//!
//! A vertex that triangles share stands in the file once for each of them, and is stored as often:
//! merging equal vertices would take a search and would change no image. The normals of the file
//! are ignored; the order of the corners decides on the side, as everywhere.

mod binary;
mod separate;
mod text;

use std::path::Path;

use super::{Loaded, MeshFormat};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{Budget, without_utf8_mark};

/// Whether `content` is surely an STL file. A binary one is told by its size, since programs write
/// anything into its first bytes, even `solid`.
pub(super) fn recognises(content: &[u8]) -> bool {
    binary::has_exact_size(content) || text::begins(without_utf8_mark(content))
}

/// Parses the content of an STL file; `path` is for messages only.
pub(super) fn parse(path: &Path, content: &[u8], budget: &Budget) -> Result<Loaded> {
    let text = without_utf8_mark(content);
    if binary::has_exact_size(content) {
        return binary::read(path, content, budget);
    }
    if text::begins(text) {
        return text::read(path, text, budget);
    }
    if let Some(error) = MeshFormat::Stl.refused(path, content) {
        return Err(error);
    }
    if !text::is_text(content) {
        // Its size is wrong, as its reader reports.
        return binary::read(path, content, budget);
    }
    let diagnostic = Diagnostic::new("not an STL mesh").at(SourceLocation::file(path));
    Err(Error::bad_input(
        diagnostic.note("expected `solid` as the first word, or binary data"),
    ))
}
