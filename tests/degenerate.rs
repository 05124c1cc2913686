//! Tests every builder with degenerate input.

mod common;

use common::{add_triangles, agreed_picture};
use feimos::accel::Precision;
use feimos::camera::{Camera, Projection, ScreenWindow};
use feimos::geometry::{Matrix, Point, Transform, Vector};
use feimos::shape::{Cut, Disk, Form, Geometry, Revolved};

fn camera() -> Camera {
    let eye = Point::new(0.0, 0.0, -4.0);
    let look_at = Transform::look_at(eye, Point::default(), Vector::new(0.0, 1.0, 0.0)).unwrap();
    Camera {
        world_from_camera: look_at.inverse,
        projection: Projection::perspective(90.0),
        screen_window: ScreenWindow::of_aspect(1.0),
        resolution: [7, 7],
    }
}

/// The small triangle in front of the camera, moved along the view.
fn triangle(z: f64) -> [Point; 3] {
    [
        Point::new(-2.0, -2.0, z),
        Point::new(2.0, -2.0, z),
        Point::new(0.0, 2.0, z),
    ]
}

fn mesh(triangles: impl IntoIterator<Item = [Point; 3]>) -> Geometry {
    let triangles: Vec<[Point; 3]> = triangles.into_iter().collect();
    let mut geometry = Geometry::default();
    add_triangles(&mut geometry, &triangles, &Matrix::IDENTITY, 1);
    geometry
}

fn spheres(all: impl IntoIterator<Item = (Matrix, f64)>) -> Geometry {
    let mut geometry = Geometry::default();
    for (matrix, radius) in all {
        let transform = geometry.add_transform(matrix);
        geometry.add_sphere(radius, None, transform, 1).unwrap();
    }
    geometry
}

/// The number of pixels of the triangle at z = 0. Their centres are 8/7 apart there: three lie in
/// the row below the middle, one in the middle row and one above it.
const IN_TRIANGLE: u64 = 5;

/// The hits among the 49 pixels, which must be the same for all builders.
fn hits(geometry: &Geometry) -> u64 {
    Precision::ALL.map(|precision| agreed_picture(&camera(), geometry, precision).traced.hits)[0]
}

#[test]
fn an_empty_scene() {
    assert_eq!(hits(&Geometry::default()), 0);
    assert_eq!(hits(&mesh([])), 0);
}

#[test]
fn a_single_triangle() {
    assert_eq!(hits(&mesh([triangle(0.0)])), IN_TRIANGLE);
    assert!(hits(&spheres([(Matrix::IDENTITY, 1.0)])) > 0);
}

#[test]
fn equal_triangles() {
    assert_eq!(hits(&mesh([triangle(0.0); 1000])), IN_TRIANGLE);
    assert_eq!(
        hits(&spheres([(Matrix::IDENTITY, 1.0); 100])),
        hits(&spheres([(Matrix::IDENTITY, 1.0)]))
    );
}

#[test]
fn triangles_without_area() {
    let point = Point::new(0.0, 0.0, 1.0);
    let collinear = [
        Point::new(-1.0, -1.0, 0.0),
        Point::new(0.0, 0.0, 0.0),
        Point::new(1.0, 1.0, 0.0),
    ];
    assert_eq!(hits(&mesh([[point; 3], collinear])), 0);
    let mixed = [[point; 3], triangle(1.0), collinear, triangle(0.0)];
    assert_eq!(hits(&mesh(mixed)), IN_TRIANGLE);
}

#[test]
fn non_finite_vertices() {
    let mut geometry = vec![triangle(0.0)];
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for axis in 0..3 {
            let mut corners = triangle(-1.0);
            let mut coordinates = corners[1].to_array();
            coordinates[axis] = wrong;
            corners[1] = coordinates.into();
            geometry.push(corners);
        }
    }
    assert_eq!(hits(&mesh(geometry)), IN_TRIANGLE);
    let wrong = [
        (Matrix::IDENTITY, f64::NAN),
        (Matrix::IDENTITY, f64::INFINITY),
        (Matrix::IDENTITY, 0.0),
        (Matrix::IDENTITY, -1.0),
        (Matrix::translate([f64::NAN, 0.0, 0.0]), 1.0),
        (Matrix::scale([1.0, 0.0, 1.0]), 1.0),
        (Matrix::scale([1.0, f64::INFINITY, 1.0]), 1.0),
    ];
    assert_eq!(hits(&spheres(wrong)), 0);
    let mut others = Geometry::default();
    for (matrix, radius) in wrong {
        let transform = others.add_transform(matrix);
        others
            .add_quadric(
                radius,
                Form::Cylinder(Cut::of_cylinder(-1.0, 1.0, 360.0)),
                transform,
                1,
            )
            .unwrap();
        others
            .add_quadric(radius, Form::Disk(Disk::new(0.0, 0.0, 360.0)), transform, 1)
            .unwrap();
    }
    for (matrix, radius) in wrong {
        let transform = others.add_transform(matrix);
        for form in [
            Revolved::cone(1.0, 360.0),
            Revolved::paraboloid(0.0, 1.0, 360.0),
        ] {
            others
                .add_quadric(radius, Form::Revolved(form), transform, 1)
                .unwrap();
        }
    }
    let transform = others.add_transform(Matrix::IDENTITY);
    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0] {
        for form in [
            Revolved::cone(number, 360.0),
            Revolved::paraboloid(-number, number, 360.0),
            Revolved::hyperboloid([1.0, number, 0.0], [1.0, 1.0, number], 360.0),
            Revolved::hyperboloid([number; 3], [1.0; 3], 360.0),
        ] {
            others
                .add_quadric(1.0, Form::Revolved(form), transform, 1)
                .unwrap();
        }
        let corner =
            |x: f64, y: f64| Point::new(x, y, if number == 0.0 { x * 1e-300 } else { 1.0 });
        let mut corners = [
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(2.0, 0.0),
            corner(3.0, 0.0),
        ];
        corners[2].y = number;
        others.add_patch(corners, &Matrix::IDENTITY, 1).unwrap();
    }
    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        others
            .add_quadric(
                1.0,
                Form::Cylinder(Cut::of_cylinder(number, 1.0, 360.0)),
                transform,
                1,
            )
            .unwrap();
        others
            .add_quadric(1.0, Form::Disk(Disk::new(number, 0.0, 360.0)), transform, 1)
            .unwrap();
        others
            .add_quadric(1.0, Form::Disk(Disk::new(0.0, number, 360.0)), transform, 1)
            .unwrap();
    }
    assert_eq!(hits(&others), 0);
}

#[test]
fn coordinates_at_the_ends_of_the_range() {
    let huge = [
        Point::new(-1e308, -1e308, 1e308),
        Point::new(1e308, -1e308, 1e308),
        Point::new(0.0, 1e308, 1e308),
    ];
    let tiny = triangle(0.0).map(|p| Point::new(p.x * 1e-320, p.y * 1e-320, 0.0));
    assert!(hits(&mesh([huge, triangle(0.0), tiny])) >= IN_TRIANGLE);
    let sizes = [1e-308, 1e-200, 1.0, 1e200, 1e307];
    assert!(hits(&spheres(sizes.map(|size| (Matrix::scale([size; 3]), 1.0)))) > 0);
    let mut others = Geometry::default();
    for size in sizes {
        let transform = others.add_transform(Matrix::scale([size; 3]));
        for form in [
            Revolved::cone(1.0, 300.0),
            Revolved::paraboloid(0.0, 1.0, 300.0),
            Revolved::hyperboloid([1.0, -1.0, -1.0], [1.0, 1.0, 1.0], 300.0),
        ] {
            others
                .add_quadric(1.0, Form::Revolved(form), transform, 1)
                .unwrap();
        }
        let corner = |x: f64, y: f64| Point::new(x * size, y * size, x * y * size);
        let corners = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(-1.0, 1.0),
            corner(1.0, 1.0),
        ];
        others.add_patch(corners, &Matrix::IDENTITY, 1).unwrap();
    }
    assert!(hits(&others) > 0);
}

/// Checks that neither the recursion nor a stack overflows.
#[test]
fn ten_thousand_equal_centroids() {
    let around = (1..=10_000)
        .map(|k| triangle(0.0).map(|p| Point::new(p.x * f64::from(k), p.y * f64::from(k), 0.0)));
    assert_eq!(hits(&mesh(around)), 49);
}

#[test]
fn ten_thousand_parallel_layers() {
    let layers = (0..10_000).map(|k| triangle(f64::from(k) * 1e-4));
    assert_eq!(hits(&mesh(layers)), IN_TRIANGLE);
}

/// Sizes that halve repeatedly lead to the deepest trees of the middle split.
#[test]
fn sizes_that_halve_repeatedly() {
    let shrinking = (0..1000).map(|k| {
        triangle(0.0).map(|p| Point::new(p.x * 0.5f64.powi(k), p.y * 0.5f64.powi(k), -p.z))
    });
    assert_eq!(hits(&mesh(shrinking)), IN_TRIANGLE);
    let towards_the_eye = (0..1000).map(|k| triangle(-4.0 + 4.0 * 0.5f64.powi(k)));
    assert!(hits(&mesh(towards_the_eye)) >= IN_TRIANGLE);
}

/// How near triangles are that cross the eye's plane is unknown, and bins hold more of them than are
/// tested at once. All must be tested before others are left out for being farther than a hit.
#[test]
fn no_triangle_of_unknown_nearness_is_left_out() {
    let triangles = [
        [[0, 0, 0], [0, 0, 1], [0, -1, 0]],
        [[0, 0, 0], [0, -3, 0], [0, 0, 1]],
        [[0, 0, 0], [0, 0, -1], [0, -1, 0]],
        [[1, -2, -1], [-2, 0, 4], [0, 0, -2]],
        [[0, 0, 0], [0, 0, -1], [1, 0, 0]],
        [[0, 0, 0], [0, 0, -1], [1, 0, 0]],
        [[-1, -2, 0], [0, 0, -2], [0, 0, 0]],
        [[0, 0, -2], [0, 0, 0], [0, 1, 0]],
        [[-1, 0, -1], [0, 0, 0], [0, 1, 0]],
        [[2, 1, 0], [0, 0, -1], [0, 0, 0]],
        [[0, 0, 0], [0, 0, 1], [0, -1, 0]],
        [[0, 1, 0], [0, 0, -1], [0, 0, 0]],
        [[0, 0, 0], [0, -1, 0], [0, 0, 1]],
        [[0, 0, 0], [0, 0, -1], [0, -1, 0]],
        [[0, 0, 0], [0, -3, 0], [0, 0, 1]],
        [[0, 2, 0], [0, 0, 0], [0, 0, 1]],
        [[-2, 0, -3], [1, 0, 0], [0, 0, 0]],
        [[0, 0, 0], [0, 2, -3], [0, 0, 1]],
        [[1, -2, -1], [2, 1, -1], [-3, 0, 0]],
    ];
    let corner = |corner: [i32; 3]| Point::from(corner.map(f64::from));
    let geometry = mesh(triangles.map(|triangle| triangle.map(corner)));
    let eye = Point::new(0.0, -1.0, -1.0);
    let look_at = Transform::look_at(eye, Point::default(), Vector::new(0.0, 1.0, 0.0)).unwrap();
    let camera = Camera {
        world_from_camera: look_at.inverse,
        resolution: [1, 1],
        ..camera()
    };
    agreed_picture(&camera, &geometry, Precision::Exact);
}
