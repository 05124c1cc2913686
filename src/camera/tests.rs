//! Rays of small cameras, by hand.

use super::*;

fn camera(projection: Projection, resolution: [u32; 2]) -> Camera {
    let aspect = f64::from(resolution[0]) / f64::from(resolution[1]);
    let screen_window = ScreenWindow::of_aspect(aspect);
    Camera {
        world_from_camera: Matrix::IDENTITY,
        projection,
        screen_window,
        resolution,
    }
}

#[test]
fn the_middle_pixel_looks_along_the_view() {
    let camera = camera(Projection::perspective(90.0), [33, 33]);
    assert_eq!(camera.ray(16, 16).direction, Vector::new(0.0, 0.0, 1.0));
    assert_eq!(
        camera.ray(0, 0).direction,
        Vector::new(-32.0 / 33.0, 32.0 / 33.0, 1.0)
    );
}

#[test]
fn the_shorter_side_spans_the_field_of_view() {
    let wide = camera(Projection::perspective(90.0), [4, 2]);
    assert_eq!(wide.ray(3, 0).direction, Vector::new(1.5, 0.5, 1.0));
    let tall = camera(Projection::perspective(90.0), [2, 4]);
    assert_eq!(tall.ray(1, 0).direction, Vector::new(0.5, 1.5, 1.0));
}

#[test]
fn spherical_rays_are_turned_into_the_world() {
    let mut camera = camera(
        Projection::Spherical(SphereMapping::Equirectangular),
        [2, 1],
    );
    camera.world_from_camera = Matrix {
        rows: [
            [0.0, 0.0, 3.0, 7.0],
            [0.0, 1.0, 0.0, 8.0],
            [-1.0, 0.0, 0.0, 9.0],
        ],
    };
    let ray = camera.ray(0, 0);
    assert_eq!(
        (ray.origin, ray.direction),
        (Point::new(7.0, 8.0, 9.0), Vector::new(3.0, 0.0, 0.0))
    );
    assert!(!camera.projection.is_linear() && !camera.projection.has_planar_depth());
}

#[test]
fn orthographic_rays_are_parallel() {
    let camera = camera(Projection::Orthographic, [2, 2]);
    let ray = camera.ray(1, 1);
    assert_eq!(
        (ray.origin, ray.direction),
        (Point::new(0.5, -0.5, 0.0), Vector::new(0.0, 0.0, 1.0))
    );
}
