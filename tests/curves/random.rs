//! Random curves against the reference, in every way that pictures are made.

use super::common::{
    add_triangles, agreed_picture, cases, grid_camera, judged, picture, rendered, whole,
};
use super::hair::{Hair, corner, hair, matrix, point, projection};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::camera::{Camera, Projection};
use feimos::exact::times_power_of_two;
use feimos::geometry::{Matrix, Point, Transform, Vector};
use feimos::shape::Geometry;
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

fn agrees_with_the_reference(camera: &Camera, geometry: &Geometry) -> Result<(), TestCaseError> {
    let expected = judged(camera, geometry);
    for method in [SplitMethod::None, SplitMethod::Sah] {
        let options = BuildOptions {
            method,
            max_leaf: 2,
        };
        let window = whole(camera);
        let image = picture(camera, geometry, options, Precision::Exact, 1, window).image;
        prop_assert_eq!(&rendered(&image), &expected, "{}", method);
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(800))]

    /// Small integers make rays that touch sides, pass joints and run along axes.
    #[test]
    fn on_integer_grids(
        hairs in prop::collection::vec(hair(), 1..4),
        triangles in prop::collection::vec(prop::array::uniform3(corner(3)), 0..3),
        eye in corner(6),
        projection in projection(),
    ) {
        let mut geometry = Geometry::default();
        hairs.iter().zip(1..).for_each(|(hair, shape)| hair.add_to(&mut geometry, &Matrix::IDENTITY, shape));
        let triangles: Vec<[Point; 3]> = triangles.iter().map(|corners| corners.each_ref().map(point)).collect();
        add_triangles(&mut geometry, &triangles, &Matrix::IDENTITY, 9);
        let camera = grid_camera(Matrix::translate(eye.map(f64::from)), projection, 7);
        agrees_with_the_reference(&camera, &geometry)?;
    }

    /// The same under matrices that round, in instances, and at any scale.
    #[test]
    fn under_random_transforms(
        hairs in prop::collection::vec(hair(), 1..4),
        world_from_object in matrix(),
        instance in matrix(),
        exponent in prop::sample::select(vec![0, 0, 0, -900, -60, 40, 900]),
        eye in corner(5),
        projection in projection(),
        moves_camera in any::<bool>(),
    ) {
        let size = Matrix::scale([times_power_of_two(1.0, exponent); 3]);
        let world_from_object = size.times(&world_from_object);
        let (mut geometry, mut object) = (Geometry::default(), Geometry::default());
        for (hair, shape) in hairs.iter().zip(1..) {
            hair.add_to(&mut geometry, &world_from_object, shape);
            hair.add_to(&mut object, &world_from_object, shape);
        }
        let object = geometry.add_object(object);
        geometry.add_instance(object, instance).unwrap();
        let eye = Matrix::translate(eye.map(f64::from));
        let world_from_camera = if moves_camera {
            world_from_object.times(&eye)
        } else {
            size.times(&eye)
        };
        agrees_with_the_reference(&grid_camera(world_from_camera, projection, 5), &geometry)?;
    }
}

proptest! {
    #![proptest_config(cases(30))]

    /// Many hairs: all accelerators, instruction sets, threads and kinds of trees.
    #[test]
    fn every_way_gives_the_same_picture(
        hairs in prop::collection::vec(hair(), 1..12),
        turn in prop::sample::select(vec![0, 37]),
        width in prop::sample::select(vec![1.0, 0.1]),
        eye in corner(6),
        projection in projection(),
        resolution in prop::sample::select(vec![9, 21]),
    ) {
        let turn = Transform::rotate(f64::from(turn), Vector::new(1.0, 2.0, 3.0)).matrix;
        let place = turn.times(&Matrix::scale([1.0, 1.0, width]));
        let (mut geometry, mut object) = (Geometry::default(), Geometry::default());
        for (hair, shape) in hairs.iter().zip(1..) {
            hair.add_to(&mut geometry, &place, shape);
            hair.add_to(&mut object, &Matrix::IDENTITY, shape);
        }
        let object = geometry.add_object(object);
        geometry.add_instance(object, Matrix::translate([2.0, 0.5, 1.0])).unwrap();
        let eye = Point::from(eye.map(|x| f64::from(x) + 0.1));
        let up = Vector::new(0.0, 1.0, 0.0);
        let look_at = Transform::look_at(eye, Point::default(), up);
        let look_at = look_at.unwrap_or(Transform::translate([0.0, 0.0, 5.0]));
        let mut camera = grid_camera(look_at.inverse, projection, 5);
        camera.resolution = [resolution; 2];
        let exact = agreed_picture(&camera, &geometry, Precision::Exact).image;
        prop_assert_eq!(&rendered(&exact), &judged(&camera, &geometry));
        agreed_picture(&camera, &geometry, Precision::Fast);
    }
}

/// The line of a segment passes the ray behind the eye, but the round end of the segment is ahead.
#[test]
fn an_end_is_hit_where_the_line_is_behind() {
    let hair = Hair {
        points: vec![
            ([0, 0, 0], 0),
            ([0, 3, -3], 0),
            ([-2, -2, 0], 3),
            ([0, 0, -1], 0),
        ],
        directions: [[0; 3]; 2],
    };
    let (mut geometry, mut object) = (Geometry::default(), Geometry::default());
    hair.add_to(&mut geometry, &Matrix::IDENTITY, 1);
    hair.add_to(&mut object, &Matrix::IDENTITY, 1);
    let object = geometry.add_object(object);
    geometry
        .add_instance(object, Matrix::translate([2.0, 0.5, 1.0]))
        .unwrap();
    let eye = Point::new(-2.9, -5.9, 3.1);
    let look_at = Transform::look_at(eye, Point::default(), Vector::new(0.0, 1.0, 0.0)).unwrap();
    let mut camera = grid_camera(look_at.inverse, Projection::Perspective { tangent: 1.0 }, 5);
    camera.resolution = [21; 2];
    let exact = agreed_picture(&camera, &geometry, Precision::Exact).image;
    assert_eq!(&rendered(&exact), &judged(&camera, &geometry));
}
