//! OBJ: vertices and faces of any number of corners; all objects and groups of a file are one mesh.
//!
//! Numbers are `f64`. A vertex with a fourth number is divided by it; with more than four, the others are colours and left out.
//! Vertices come in the order in which faces use them, each once, and those without a face are left out.

mod blame;
mod part;
mod plain;
mod simple;
mod statements;
#[cfg(test)]
mod tests;

use std::path::Path;

use self::plain::Plain;
use super::faces::{Faces, check_count};
use super::{Loaded, TriangleMesh, signature};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::Point;
use crate::input::gzip;

/// Polygons are ours to cut, and what `tobj` calls lines and points are faces that it finds too small.
const OPTIONS: tobj::LoadOptions =
    tobj::LoadOptions { single_index: false, triangulate: false, ignore_points: true, ignore_lines: true };

/// Reads the bytes of an OBJ file, compressed or not; `path` is for messages only.
pub fn parse_obj(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    gzip::parsed(path, bytes, |content| parse(path, signature::without_utf8_mark(content)))
}

fn parse(path: &Path, text: &[u8]) -> Result<Loaded> {
    if let Some(found) = signature::describe(text) {
        let diagnostic = Diagnostic::new(format!("not an OBJ mesh: this is {found}"));
        return Err(Error::bad_input(diagnostic.at(SourceLocation::file(path))));
    }
    match simple::read(text) {
        Some(mesh) => Ok(Loaded::new(path, mesh, Vec::new())),
        None => parse_odd(path, text),
    }
}

/// Reads any OBJ file.
fn parse_odd(path: &Path, text: &[u8]) -> Result<Loaded> {
    let mut plain = Plain::new(text);
    let models = tobj::load_obj_buf(&mut plain, &OPTIONS, |_| Ok(Default::default()));
    let (models, _) = models.map_err(|error| refused(path, text, &error))?;
    let at_file = |error: Error| error.or_at(|| SourceLocation::file(path));
    check_count(plain.vertices, "vertices").map_err(at_file)?;
    let mut faces = models.into_iter().next().map(|model| model.mesh).unwrap_or_default();
    let vertices = points(std::mem::take(&mut faces.positions));
    let triangles = triangles(&faces, &vertices, |face| blame::face(path, text, face)).map_err(at_file)?;
    let small = plain.small.in_text(path, text, "face of fewer than 3 corners, left out");
    let unknown = plain.unknown.in_text(path, text, "statement that OBJ does not know, left out");
    let warnings = small.into_iter().chain(unknown).collect();
    Ok(Loaded::new(path, TriangleMesh { vertices, triangles }, warnings))
}

fn points(coordinates: Vec<f64>) -> Vec<Point> {
    coordinates.chunks_exact(3).map(|point| Point::new(point[0], point[1], point[2])).collect()
}

fn triangles(
    mesh: &tobj::Mesh,
    vertices: &[Point],
    location: impl Fn(usize) -> SourceLocation,
) -> Result<Vec<[u32; 3]>> {
    let arities = &mesh.face_arities;
    // No arities at all mean that all faces are triangles.
    let count = if arities.is_empty() { mesh.indices.len() / 3 } else { arities.len() };
    let mut faces = Faces::new(vertices, mesh.indices.len() - 2 * count);
    let mut rest = mesh.indices.as_slice();
    for face in 0..count {
        let (corners, others) = rest.split_at(arities.get(face).map_or(3, |arity| *arity as usize));
        // Faces of fewer corners have been left out before.
        faces.push(corners, || 0..0).map_err(|error| error.or_at(|| location(face)))?;
        rest = others;
    }
    Ok(faces.finish()?.0)
}

fn refused(path: &Path, text: &[u8], error: &tobj::LoadError) -> Error {
    let otherwise =
        || Diagnostic::new(format!("the OBJ reader refuses this file: {error}")).at(SourceLocation::file(path));
    Error::bad_input(blame::find(path, text).unwrap_or_else(otherwise))
}
