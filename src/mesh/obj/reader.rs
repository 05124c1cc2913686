//! The general OBJ reader: `tobj`, with errors and warnings that name a line.

use std::path::Path;

use crate::parallel::CollectVec;
use rayon::prelude::*;

use super::mistakes;
use super::plain::Plain;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::Point;
use crate::input::Budget;
use crate::mesh::faces::{Faces, check_count};
use crate::mesh::{CornerWants, Loaded, TriangleMesh};
use crate::shape::{CornerNormals, CornerUv};

/// The library cuts polygons itself. `tobj` calls faces that are too small lines and points.
const OPTIONS: tobj::LoadOptions = tobj::LoadOptions {
    single_index: false,
    triangulate: false,
    ignore_points: true,
    ignore_lines: true,
};

/// Reads any OBJ file, with what `wants` says of its corners.
pub(super) fn read(
    path: &Path,
    text: &[u8],
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    let mut plain = Plain::new(text, wants, budget);
    let models = tobj::load_obj_buf(&mut plain, &OPTIONS, |_| Ok(Default::default()));
    let (models, _) = models.map_err(|error| refused(path, text, wants.uv, &error))?;
    let at_file = |error: Error| error.or_at(|| SourceLocation::file(path));
    check_count(plain.vertices, "vertices").map_err(at_file)?;
    let mut mesh = models
        .into_iter()
        .next()
        .map(|model| model.mesh)
        .unwrap_or_default();
    let vertices = points(std::mem::take(&mut mesh.positions));
    let triangles = mesh.indices.len() - 2 * face_count(&mesh);
    let found = CornerWants {
        uv: wants.uv && plain.has_uv,
        normals: wants.normals && plain.has_normals,
    };
    let mut faces = match found {
        CornerWants::NOTHING => Faces::new(&vertices, triangles, budget),
        _ => Faces::with_places(&vertices, triangles, budget),
    };
    push_all(&mesh, &mut faces, budget, |face| {
        mistakes::face(path, text, face)
    })?;
    let mut corners = Vec::new();
    if found != CornerWants::NOTHING {
        check_count(mesh.indices.len() as u64, "corners").map_err(at_file)?;
        corners = corners_of_mesh(&mesh, faces.take_places());
    }
    let uv = found.uv.then(|| uv_of(&mesh, &corners));
    let normals = found.normals.then(|| normals_of(&mesh, &corners));
    let triangles = faces.finish().map_err(at_file)?.0;
    let mesh = TriangleMesh {
        vertices,
        triangles,
        uv,
        normals,
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
    budget: &Budget,
    location: impl Fn(usize) -> SourceLocation,
) -> Result<()> {
    let mut rest = mesh.indices.as_slice();
    for (face, arity) in arities(mesh).enumerate() {
        budget.check_sometimes(face as u64);
        let (corners, others) = rest.split_at(arity);
        let pushed = faces.push(corners, || 0..0);
        pushed.map_err(|error| error.or_at(|| location(face)))?;
        rest = others;
    }
    Ok(())
}

/// The corners of triangles, which are numbered within their faces, by their numbers in the mesh.
fn corners_of_mesh(mesh: &tobj::Mesh, mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    let (mut rest, mut first) = (&mut triangles[..], 0);
    for arity in arities(mesh) {
        let (own, others) = rest.split_at_mut(arity - 2);
        own.iter_mut().flatten().for_each(|corner| *corner += first);
        (rest, first) = (others, first + arity as u32);
    }
    triangles
}

/// Texture coordinates at the corners of triangles.
fn uv_of(mesh: &tobj::Mesh, triangles: &[[u32; 3]]) -> Vec<CornerUv> {
    let uv_of_corner = |corner: u32| {
        let at = 2 * mesh.texcoord_indices[corner as usize] as usize;
        [mesh.texcoords[at] as f32, mesh.texcoords[at + 1] as f32]
    };
    triangles
        .par_iter()
        .map(|corners| corners.map(uv_of_corner))
        .collect_vec()
}

/// Normals at the corners of triangles.
fn normals_of(mesh: &tobj::Mesh, triangles: &[[u32; 3]]) -> Vec<CornerNormals> {
    let normal_of_corner = |corner: u32| {
        let at = 3 * mesh.normal_indices[corner as usize] as usize;
        [0, 1, 2].map(|k| mesh.normals[at + k] as f32)
    };
    triangles
        .par_iter()
        .map(|corners| corners.map(normal_of_corner))
        .collect_vec()
}

fn refused(path: &Path, text: &[u8], with_uv: bool, error: &tobj::LoadError) -> Error {
    Error::bad_input(mistakes::find(path, text, with_uv).unwrap_or_else(|| {
        Diagnostic::new(format!("the OBJ reader refuses this file: {error}"))
            .at(SourceLocation::file(path))
    }))
}
