//! A scene for a bare mesh, with a camera that sees all of it.

use super::accelerator::AcceleratorParameters;
use super::automatic_view::{AutomaticView, FIELD_OF_VIEW};
use super::census::Census;
use super::film::Film;
use super::locations::Locations;
use super::warnings::Warnings;
use super::{LoadOptions, Scene};
use crate::camera::{Camera, Projection, ScreenWindow};
use crate::error::{Diagnostic, Error, Result, SourceLocation, counted};
use crate::film::PixelBounds;
use crate::geometry::{Matrix, Point};
use crate::mesh::{Loaded, TriangleMesh};
use crate::parallel::CollectVec;
use crate::shape::Geometry;
use rayon::prelude::*;
use std::path::Path;

/// The scene of the mesh of the file `path` in its [`AutomaticView`]. `shape` is the type that a
/// scene would give the mesh.
pub(super) fn scene_of_mesh(
    path: &Path,
    shape: &str,
    loaded: Loaded,
    options: &LoadOptions,
) -> Result<Scene> {
    let refuse =
        |message: String| Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(path)));
    let scene = framed(shape, loaded, options, refuse)?;
    Ok(Scene {
        locations: options.locations.then(|| Locations::of_mesh(path, shape)),
        ..scene
    })
}

/// The scene of the triangles with these corners, like that of a mesh file with them.
///
/// # Errors
/// A triangle with an index that no point has, or too many of them.
pub fn scene_of_triangles(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Scene> {
    let is_wrong = |index: &u32| *index as usize >= points.len();
    let wrong = triangles
        .par_iter()
        .position_first(|corners| corners.iter().any(is_wrong));
    if let Some(place) = wrong {
        let index = triangles[place].iter().copied().find(is_wrong);
        let index = index.unwrap_or_default();
        let points = counted(points.len() as u64, "point");
        let error = Error::usage(format!("triangle {place} has index {index} of {points}"));
        return Err(error.note("expected indices that count points from 0"));
    }
    let point = |point: &[f32; 3]| Point::from(point.map(f64::from));
    let mesh = TriangleMesh {
        vertices: points.par_iter().map(point).collect_vec(),
        triangles: triangles.to_vec(),
        ..TriangleMesh::default()
    };
    let mut loaded = Loaded::new(Path::new(""), mesh, Vec::new());
    // There is no file.
    let warnings = loaded.warnings.iter_mut();
    warnings.for_each(|warning| warning.location = None);
    framed(
        "trianglemesh",
        loaded,
        &LoadOptions::default(),
        Error::usage,
    )
}

/// The scene of a mesh in its [`AutomaticView`]. `refuse` makes an error of a message.
fn framed(
    shape: &str,
    loaded: Loaded,
    options: &LoadOptions,
    refuse: impl Fn(String) -> Error,
) -> Result<Scene> {
    let resolution = options.resolution.unwrap_or([1280, 720]);
    let mut warnings = Warnings::default();
    loaded
        .warnings
        .into_iter()
        .for_each(|warning| warnings.add_single(warning));
    let mesh = loaded.mesh;
    let aspect = f64::from(resolution[0]) / f64::from(resolution[1]);
    let screen_window = ScreenWindow::of_aspect(aspect);
    let Some(view) = AutomaticView::of(&mesh.vertices, &screen_window) else {
        let error = refuse("the mesh is too large to be framed automatically".to_owned());
        return Err(error.note("write a scene with a Scale and a LookAt around it"));
    };
    let mut geometry = Geometry::default();
    geometry
        .add_mesh(mesh.vertices, mesh.triangles, &Matrix::IDENTITY, 1)
        .map_err(|error| refuse(error.to_string()))?;
    geometry.add_uv(mesh.uv.unwrap_or_default());
    geometry.add_normals(mesh.normals.unwrap_or_default(), &Matrix::IDENTITY, false);
    let mut census = Census::default();
    census.count_shape(shape, Some(geometry.own_count()));
    let crop = PixelBounds::of_film(resolution[0], resolution[1]);
    Ok(Scene {
        camera: Camera {
            world_from_camera: view.camera_from_world.inverse,
            projection: Projection::perspective(FIELD_OF_VIEW),
            screen_window,
            resolution,
        },
        film: Film {
            resolution,
            crop,
            filename: None,
        },
        accelerator: AcceleratorParameters::default(),
        geometry,
        shape_count: 1,
        transform_count: 1,
        warnings,
        census,
        locations: None,
        transform_history: options.transform_history.then(|| view.history()),
    })
}
