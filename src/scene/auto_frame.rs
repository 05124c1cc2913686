//! A camera for a bare mesh.

use super::{AcceleratorParameters, Census, Film, LoadOptions, Places, Roundings, Scene, Warnings};
use crate::camera::{Camera, Projection, ScreenWindow};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::film::PixelBounds;
use crate::geometry::{Bounds, Matrix, RoundedTransform, Transform, Vector};
use crate::mesh::Loaded;
use crate::shape::Geometry;
use std::path::Path;
use std::sync::Arc;

/// In degrees, across the shorter side of the film.
const FIELD_OF_VIEW: f64 = 40.0;

/// A mesh thinner than this, in parts of its size, would be hard to see along its edge.
const FLAT: f64 = 0.01;

/// How much farther away the eye stands than the ball around the mesh needs.
const MARGIN: f64 = 1.02;

/// The scene of one mesh, seen whole from +z with y upwards and x to the right: the way its maker sees it, not
/// mirrored by pbrt's left-handed camera. A mesh that is flat in x or y is seen from the side and above as well. `shape` is what
/// a scene would call the mesh.
pub(super) fn scene_of_mesh(
    path: &Path,
    shape: &str,
    loaded: Loaded,
    options: &LoadOptions,
) -> Result<Scene> {
    let resolution = options.resolution.unwrap_or([1280, 720]);
    let mut warnings = Warnings::default();
    loaded
        .warnings
        .into_iter()
        .for_each(|warning| warnings.add_single(warning));
    let finite = loaded
        .mesh
        .vertices
        .iter()
        .copied()
        .filter(|vertex| vertex.is_finite());
    let frame = frame(&Bounds::of(finite));
    let frame = frame
        .filter(|frame| frame.transform.inverse.is_finite())
        .ok_or_else(|| {
            let message = "the mesh is too large to be framed automatically";
            let diagnostic = Diagnostic::new(message).at(SourceLocation::file(path));
            Error::bad_input(diagnostic.note("write a scene with a Scale and a LookAt around it"))
        })?;
    let mut geometry = Geometry::default();
    let added = geometry.add_mesh(
        loaded.mesh.vertices,
        loaded.mesh.triangles,
        &Matrix::IDENTITY,
        1,
    );
    added.map_err(|error| {
        Error::bad_input(Diagnostic::new(error.to_string()).at(SourceLocation::file(path)))
    })?;
    loaded
        .mesh
        .uv
        .into_iter()
        .for_each(|uv| geometry.add_uv(uv));
    let mut census = Census::default();
    census.count_shape(shape, Some(geometry.own_count()));
    let aspect = f64::from(resolution[0]) / f64::from(resolution[1]);
    let roundings = options.roundings.then(|| Roundings {
        camera: Arc::new(frame),
        shapes: vec![Arc::new(RoundedTransform::IDENTITY)],
        instances: Vec::new(),
    });
    Ok(Scene {
        camera: Camera {
            world_from_camera: frame.transform.inverse,
            projection: Projection::perspective(FIELD_OF_VIEW),
            screen_window: ScreenWindow::of_aspect(aspect),
            resolution,
        },
        film: Film {
            resolution,
            crop: PixelBounds::of_film(resolution[0], resolution[1]),
            filename: None,
        },
        accelerator: AcceleratorParameters::default(),
        geometry,
        shape_count: 1,
        transform_count: 1,
        warnings,
        census,
        places: options.places.then(|| Places::of_mesh(path, shape)),
        roundings,
    })
}

/// Camera space from world space for a camera that sees all of `bounds`; `None` where no such place can be written in numbers. What
/// roundings move it by counts from its eye on: that is where it is meant to be.
fn frame(bounds: &Bounds) -> Option<RoundedTransform> {
    if bounds.is_empty() {
        return Some(RoundedTransform::IDENTITY);
    }
    let centre = bounds.centre();
    let to_corner = bounds.high - centre;
    let radius = to_corner.dot(to_corner).sqrt();
    let radius = if radius > 0.0 { radius } else { 1.0 };
    let half_angle = (FIELD_OF_VIEW / 2.0).to_radians();
    let flat = to_corner.x.min(to_corner.y) < FLAT * radius;
    let towards_eye = if flat {
        Vector::new(1.0, 1.0, 2.0).normalized()
    } else {
        Vector::new(0.0, 0.0, 1.0)
    };
    let eye = centre + towards_eye * (MARGIN * radius / half_angle.sin());
    let ahead = eye + towards_eye * -radius;
    let up = Vector::new(0.0, 1.0, 0.0);
    Transform::look_at(eye, ahead, up)?;
    let camera_from_world =
        RoundedTransform::look_at([eye.to_array(), ahead.to_array(), up.to_array()]);
    Some(RoundedTransform::scale([-1.0, 1.0, 1.0]).times(&camera_from_world))
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
        let camera = frame(&bounds).unwrap().transform.inverse;
        let [eye_x, eye_y, eye_z] = camera.column(3);
        assert_eq!((eye_x, eye_y), (2.0, 3.0));
        assert!(eye_z > 1.0);
        assert_eq!(camera.column(0), [1.0, 0.0, 0.0]);
        assert_eq!(camera.column(1), [0.0, 1.0, 0.0]);
        assert_eq!(camera.column(2), [0.0, 0.0, -1.0]);
    }

    #[test]
    fn odd_sizes_do_not_break_it() {
        assert!(frame(&Bounds::EMPTY).is_some());
        let point = Point::new(1.0, 1.0, 1.0);
        assert!(
            frame(&Bounds {
                low: point,
                high: point
            })
            .unwrap()
            .transform
            .inverse
            .is_finite()
        );
        let huge = Bounds {
            low: Point::new(-1e308, 0.0, 0.0),
            high: Point::new(1e308, 1.0, 1.0),
        };
        assert!(frame(&huge).is_none_or(|camera| !camera.transform.inverse.is_finite()));
    }
}
