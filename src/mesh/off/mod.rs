//! OFF meshes: three counts, a line for each vertex, and a line for each polygon.
//!
//! The first word is `OFF`, after letters that say what a vertex has besides its position: `ST` for
//! texture coordinates, `C` for a colour, `N` for a normal. Numbers behind those that a line needs,
//! such as colours, are ignored. A `#` begins a comment.

mod header;
mod reader;

use std::path::Path;

use super::{CornerWants, Loaded, MeshFormat};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{Budget, without_utf8_mark};
use header::Keyword;

/// Whether `text` begins as OFF does.
pub(super) fn recognises(text: &[u8]) -> bool {
    Keyword::at_start_of(text).is_some()
}

/// Parses the content of an OFF file, with what `wants` says of the vertices, if it has that;
/// `path` is for messages only.
pub(super) fn parse(
    path: &Path,
    content: &[u8],
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    let text = without_utf8_mark(content);
    let Some(keyword) = Keyword::at_start_of(text) else {
        return Err(MeshFormat::Off.refused(path, text).unwrap_or_else(|| {
            let diagnostic = Diagnostic::new("not an OFF mesh").at(SourceLocation::file(path));
            Error::bad_input(diagnostic.note("expected `OFF` as the first word"))
        }));
    };
    let has = |wanted: bool, found: bool| wanted && found;
    let wants = CornerWants {
        uv: has(wants.uv, keyword.has_uv),
        normals: has(wants.normals, keyword.has_normals),
    };
    reader::read(path, text, &keyword, wants, budget)
}
