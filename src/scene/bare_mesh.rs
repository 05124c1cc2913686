//! A scene for a bare mesh, with a camera that sees all of it.

use super::accelerator::AcceleratorParameters;
use super::automatic_view::{AutomaticView, FIELD_OF_VIEW};
use super::census::Census;
use super::film::Film;
use super::locations::Locations;
use super::warnings::Warnings;
use super::{LoadOptions, Scene};
use crate::camera::{Camera, Projection, ScreenWindow};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::film::PixelBounds;
use crate::geometry::Matrix;
use crate::mesh::Loaded;
use crate::shape::Geometry;
use std::path::Path;

/// The scene of one mesh in its [`AutomaticView`]. `shape` is the type that a scene would give the
/// mesh.
pub(super) fn scene_of_mesh(
    path: &Path,
    shape: &str,
    loaded: Loaded,
    options: &LoadOptions,
) -> Result<Scene> {
    let resolution = options.resolution.unwrap_or([1280, 720]);
    let refuse =
        |message: String| Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(path)));
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
        locations: options.locations.then(|| Locations::of_mesh(path, shape)),
        transform_history: options.transform_history.then(|| view.history()),
    })
}
