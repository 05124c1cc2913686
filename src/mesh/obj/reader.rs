//! The general OBJ reader: `tobj`, with errors and warnings that name a line.

use std::path::Path;

use rayon::prelude::*;

use super::mistakes;
use super::plain::Plain;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::Point;
use crate::input::Budget;
use crate::mesh::faces::{Faces, check_count};
use crate::mesh::{Loaded, TriangleMesh};
use crate::shape::CornerUv;

/// The library cuts polygons itself. `tobj` calls faces that are too small lines and points.
const OPTIONS: tobj::LoadOptions = tobj::LoadOptions {
    single_index: false,
    triangulate: false,
    ignore_points: true,
    ignore_lines: true,
};

/// Reads any OBJ file, with the texture coordinates of its corners if `with_uv`.
pub(super) fn read(path: &Path, text: &[u8], with_uv: bool, budget: &Budget) -> Result<Loaded> {
    let mut plain = Plain::new(text, with_uv);
    let models = tobj::load_obj_buf(&mut plain, &OPTIONS, |_| Ok(Default::default()));
    let (models, _) = models.map_err(|error| refused(path, text, with_uv, &error))?;
    let at_file = |error: Error| error.or_at(|| SourceLocation::file(path));
    check_count(plain.vertices, "vertices").map_err(at_file)?;
    let mut mesh = models
        .into_iter()
        .next()
        .map(|model| model.mesh)
        .unwrap_or_default();
    let vertices = points(std::mem::take(&mut mesh.positions));
    let triangles = mesh.indices.len() - 2 * face_count(&mesh);
    let with_uv = with_uv && plain.has_uv;
    let mut faces = match with_uv {
        true => Faces::with_places(&vertices, triangles, budget),
        false => Faces::new(&vertices, triangles, budget),
    };
    push_all(&mesh, &mut faces, |face| mistakes::face(path, text, face))?;
    let uv = if with_uv {
        check_count(mesh.indices.len() as u64, "corners").map_err(at_file)?;
        Some(uv_of(&mesh, faces.take_places()))
    } else {
        None
    };
    let triangles = faces.finish().map_err(at_file)?.0;
    let mesh = TriangleMesh {
        vertices,
        triangles,
        uv,
    };
    Ok(Loaded::new(path, mesh, plain.warnings(path)))
}

fn points(coordinates: Vec<f64>) -> Vec<Point> {
    let points = coordinates.chunks_exact(3);
    points
        .map(|point| Point::new(point[0], point[1], point[2]))
        .collect()
}

/// The number of faces. Without arities all faces are triangles.
fn face_count(mesh: &tobj::Mesh) -> usize {
    match mesh.face_arities.len() {
        0 => mesh.indices.len() / 3,
        count => count,
    }
}

/// The number of corners of each face.
fn arities(mesh: &tobj::Mesh) -> impl Iterator<Item = usize> {
    (0..face_count(mesh)).map(|face| {
        mesh.face_arities
            .get(face)
            .map_or(3, |arity| *arity as usize)
    })
}

/// Adds all faces of `mesh` to `faces`; all have at least three corners.
fn push_all(
    mesh: &tobj::Mesh,
    faces: &mut Faces,
    location: impl Fn(usize) -> SourceLocation,
) -> Result<()> {
    let mut rest = mesh.indices.as_slice();
    for (face, arity) in arities(mesh).enumerate() {
        let (corners, others) = rest.split_at(arity);
        let pushed = faces.push(corners, || 0..0);
        pushed.map_err(|error| error.or_at(|| location(face)))?;
        rest = others;
    }
    Ok(())
}

/// Texture coordinates at the corners of triangles, which are numbered within their faces.
fn uv_of(mesh: &tobj::Mesh, mut triangles: Vec<[u32; 3]>) -> Vec<CornerUv> {
    let (mut rest, mut first) = (&mut triangles[..], 0);
    for arity in arities(mesh) {
        let (own, others) = rest.split_at_mut(arity - 2);
        own.iter_mut().flatten().for_each(|corner| *corner += first);
        (rest, first) = (others, first + arity as u32);
    }
    let uv_of_corner = |corner: u32| {
        let at = 2 * mesh.texcoord_indices[corner as usize] as usize;
        [mesh.texcoords[at] as f32, mesh.texcoords[at + 1] as f32]
    };
    triangles
        .par_iter()
        .map(|corners| corners.map(uv_of_corner))
        .collect()
}

fn refused(path: &Path, text: &[u8], with_uv: bool, error: &tobj::LoadError) -> Error {
    Error::bad_input(mistakes::find(path, text, with_uv).unwrap_or_else(|| {
        Diagnostic::new(format!("the OBJ reader refuses this file: {error}"))
            .at(SourceLocation::file(path))
    }))
}
