//! A scene for a bare mesh, with a camera that sees all of it.

use super::accelerator::AcceleratorParameters;
use super::census::Census;
use super::film::Film;
use super::locations::Locations;
use super::parser::TransformDirective;
use super::transform_history::{TransformHistory, TransformStep};
use super::warnings::Warnings;
use super::{LoadOptions, Scene};
use crate::camera::{Camera, Projection, ScreenWindow};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::film::PixelBounds;
use crate::geometry::{Bounds, Matrix, Transform, Vector};
use crate::mesh::Loaded;
use crate::shape::Geometry;
use std::path::Path;

/// The field of view in degrees, across the shorter side of the film.
const FIELD_OF_VIEW: f64 = 40.0;

/// A mesh thinner than this part of its size would be hard to see along its edge.
const FLAT: f64 = 0.01;

/// How much farther away the eye stands than the ball around the mesh needs.
const MARGIN: f64 = 1.02;

/// The scene of one mesh, seen whole from +z with y up and x to the right: as its maker sees it,
/// not mirrored by pbrt's left-handed camera. A mesh that is flat in x or y is seen from the side
/// and above as well. `shape` is the type that a scene would give the mesh.
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
    let finite = mesh
        .vertices
        .iter()
        .copied()
        .filter(|vertex| vertex.is_finite());
    let framed = frame(&Bounds::of(finite)).filter(|(frame, _)| frame.inverse.is_finite());
    let Some((frame, directives)) = framed else {
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
    let aspect = f64::from(resolution[0]) / f64::from(resolution[1]);
    let crop = PixelBounds::of_film(resolution[0], resolution[1]);
    Ok(Scene {
        camera: Camera {
            world_from_camera: frame.inverse,
            projection: Projection::perspective(FIELD_OF_VIEW),
            screen_window: ScreenWindow::of_aspect(aspect),
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
        transform_history: options.transform_history.then(|| history(&directives)),
    })
}

/// Camera space from world space for a camera that sees all of `bounds`, and the directives for it.
/// `None` if no number is large enough. Roundings count from the eye on: there it is meant to be.
fn frame(bounds: &Bounds) -> Option<(Transform, Vec<TransformDirective>)> {
    if bounds.is_empty() {
        return Some((Transform::IDENTITY, Vec::new()));
    }
    let centre = bounds.centre();
    let to_corner = bounds.high - centre;
    let radius = to_corner.dot(to_corner).sqrt();
    let radius = if radius > 0.0 { radius } else { 1.0 };
    let half_angle = (FIELD_OF_VIEW / 2.0).to_radians();
    let towards_eye = match to_corner.x.min(to_corner.y) < FLAT * radius {
        true => Vector::new(1.0, 1.0, 2.0).normalized(),
        false => Vector::new(0.0, 0.0, 1.0),
    };
    let eye = centre + towards_eye * (MARGIN * radius / half_angle.sin());
    let ahead = eye + towards_eye * -radius;
    let camera_from_world = Transform::look_at(eye, ahead, Vector::new(0.0, 1.0, 0.0))?;
    let mirror = [-1.0, 1.0, 1.0];
    let look_at = [
        eye.x, eye.y, eye.z, ahead.x, ahead.y, ahead.z, 0.0, 1.0, 0.0,
    ];
    let directives = vec![
        TransformDirective::Scale(mirror),
        TransformDirective::LookAt(look_at),
    ];
    Some((
        Transform::scale(mirror).times(&camera_from_world),
        directives,
    ))
}

fn history(directives: &[TransformDirective]) -> TransformHistory {
    let mut history = TransformHistory::default();
    history.shapes.push(TransformHistory::IDENTITY);
    for directive in directives {
        history.camera = history.add(TransformStep::Directive(history.camera, *directive));
    }
    history
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    #[test]
    fn sees_the_whole_box_with_x_to_the_right() {
        let bounds = Bounds {
            low: Point::new(-1.0, 2.0, -3.0),
            high: Point::new(5.0, 4.0, 1.0),
        };
        let camera = frame(&bounds).unwrap().0.inverse;
        let [eye_x, eye_y, eye_z] = camera.column(3);
        assert_eq!((eye_x, eye_y), (2.0, 3.0));
        assert!(eye_z > 1.0);
        assert_eq!(camera.column(0), [1.0, 0.0, 0.0]);
        assert_eq!(camera.column(1), [0.0, 1.0, 0.0]);
        assert_eq!(camera.column(2), [0.0, 0.0, -1.0]);
    }

    #[test]
    fn a_point_is_framed_and_a_huge_box_is_not() {
        assert!(frame(&Bounds::EMPTY).is_some());
        let point = Point::new(1.0, 1.0, 1.0);
        let is_framed = |low: Point, high: Point| {
            frame(&Bounds { low, high }).is_some_and(|(camera, _)| camera.inverse.is_finite())
        };
        assert!(is_framed(point, point));
        assert!(!is_framed(
            Point::new(-1e308, 0.0, 0.0),
            Point::new(1e308, 1.0, 1.0)
        ));
    }
}
