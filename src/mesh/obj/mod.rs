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
mod texture;

use std::path::Path;

use self::plain::Plain;
use self::texture::Texture;
use super::faces::{Faces, check_count};
use super::{Loaded, TriangleMesh, signature};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::Point;
use crate::input::{Budget, gzip};

/// Polygons are ours to cut, and what `tobj` calls lines and points are faces that it finds too small.
const OPTIONS: tobj::LoadOptions = tobj::LoadOptions {
    single_index: false,
    triangulate: false,
    ignore_points: true,
    ignore_lines: true,
};

/// Reads the bytes of an OBJ file, compressed or not; `path` is for messages only.
pub(super) fn parse_any(path: &Path, bytes: &[u8], budget: &Budget) -> Result<Loaded> {
    gzip::parsed(path, bytes, budget, |content| {
        parse(path, signature::without_utf8_mark(content), budget)
    })
}

/// As [`parse_any`], with u and v of the corners, if the file has them.
pub(super) fn parse_with_uv(path: &Path, bytes: &[u8], budget: &Budget) -> Result<Loaded> {
    gzip::parsed(path, bytes, budget, |content| {
        let text = signature::without_utf8_mark(content);
        if signature::describe(text).is_some() || !Texture::is_in(text) {
            return parse(path, text, budget);
        }
        let mut uv = Vec::new();
        let mut loaded = read(path, text, Some(&mut uv), budget)?;
        let texture = Texture::read(path, text)?;
        loaded.mesh.uv = texture.uv(&uv);
        loaded.warnings.extend(texture.warning);
        Ok(loaded)
    })
}

fn parse(path: &Path, text: &[u8], budget: &Budget) -> Result<Loaded> {
    if let Some(found) = signature::describe(text) {
        let diagnostic = Diagnostic::new(format!("not an OBJ mesh: this is {found}"));
        return Err(Error::bad_input(diagnostic.at(SourceLocation::file(path))));
    }
    match simple::read(text, budget) {
        Some(mesh) => Ok(Loaded::new(path, mesh, Vec::new())),
        None => parse_odd(path, text, budget),
    }
}

/// Reads any OBJ file.
fn parse_odd(path: &Path, text: &[u8], budget: &Budget) -> Result<Loaded> {
    read(path, text, None, budget)
}

/// Reads any OBJ file. Where `corners` are wanted, they become those of the triangles, numbered through all faces.
fn read(
    path: &Path,
    text: &[u8],
    corners: Option<&mut Vec<[u32; 3]>>,
    budget: &Budget,
) -> Result<Loaded> {
    let mut plain = Plain::new(text);
    let models = tobj::load_obj_buf(&mut plain, &OPTIONS, |_| Ok(Default::default()));
    let (models, _) = models.map_err(|error| refused(path, text, &error))?;
    let at_file = |error: Error| error.or_at(|| SourceLocation::file(path));
    check_count(plain.vertices, "vertices").map_err(at_file)?;
    let mut faces = models
        .into_iter()
        .next()
        .map(|model| model.mesh)
        .unwrap_or_default();
    let vertices = points(std::mem::take(&mut faces.positions));
    let count = face_count(&faces);
    let triangles = faces.indices.len() - 2 * count;
    let mut collected = match corners {
        Some(_) => Faces::with_places(&vertices, triangles, budget),
        None => Faces::new(&vertices, triangles, budget),
    };
    push_all(&faces, &mut collected, |face| blame::face(path, text, face))?;
    if let Some(wanted) = corners {
        check_count(faces.indices.len() as u64, "corners").map_err(at_file)?;
        *wanted = collected.take_places();
        number_through(wanted, (0..count).map(|face| corners_of(&faces, face)));
    }
    let triangles = collected.finish().map_err(at_file)?.0;
    Ok(Loaded::new(
        path,
        TriangleMesh {
            vertices,
            triangles,
            uv: None,
        },
        plain.warnings(path),
    ))
}

fn points(coordinates: Vec<f64>) -> Vec<Point> {
    coordinates
        .chunks_exact(3)
        .map(|point| Point::new(point[0], point[1], point[2]))
        .collect()
}

/// No arities at all mean that all faces are triangles.
fn face_count(mesh: &tobj::Mesh) -> usize {
    if mesh.face_arities.is_empty() {
        mesh.indices.len() / 3
    } else {
        mesh.face_arities.len()
    }
}

fn corners_of(mesh: &tobj::Mesh, face: usize) -> u32 {
    mesh.face_arities.get(face).map_or(3, |arity| *arity)
}

/// Adds all faces of `mesh` to `faces`.
fn push_all(
    mesh: &tobj::Mesh,
    faces: &mut Faces,
    location: impl Fn(usize) -> SourceLocation,
) -> Result<()> {
    let mut rest = mesh.indices.as_slice();
    for face in 0..face_count(mesh) {
        let (corners, others) = rest.split_at(corners_of(mesh, face) as usize);
        // Faces of fewer corners have been left out before.
        faces
            .push(corners, || 0..0)
            .map_err(|error| error.or_at(|| location(face)))?;
        rest = others;
    }
    Ok(())
}

/// Makes numbers of corners within their faces, which have so many, numbers through all faces.
fn number_through(triangles: &mut [[u32; 3]], sizes: impl Iterator<Item = u32>) {
    let (mut rest, mut first) = (triangles, 0);
    for size in sizes {
        let (own, others) = rest.split_at_mut(size as usize - 2);
        own.iter_mut()
            .for_each(|corners| *corners = corners.map(|corner| corner + first));
        (rest, first) = (others, first + size);
    }
}

fn refused(path: &Path, text: &[u8], error: &tobj::LoadError) -> Error {
    let otherwise = || {
        Diagnostic::new(format!("the OBJ reader refuses this file: {error}"))
            .at(SourceLocation::file(path))
    };
    Error::bad_input(blame::find(path, text).unwrap_or_else(otherwise))
}
