//! Tests every accelerator against the reference, with thousands of hard scenes and rays.
//!
//! `FEIMOS_CASES=100000 cargo test --release --test reference` runs that many cases of each kind.

#[path = "../common/mod.rs"]
mod common;
mod random;

use common::{add_triangles, cases, grid_camera, judged, picture, rendered, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::camera::{Camera, Projection};
use feimos::exact::times_power_of_two;
use feimos::geometry::{Matrix, Point};
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, load};
use feimos::shape::Geometry;
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;
use random::{Ball, Corner, corner, grid_ball, matrix, point, projection};
use std::path::Path;

fn agrees_with_the_reference(camera: &Camera, geometry: &Geometry) -> Result<(), TestCaseError> {
    let expected = judged(camera, geometry);
    for method in [SplitMethod::None, SplitMethod::Sah] {
        let options = BuildOptions {
            method,
            max_leaf: 1,
        };
        let image = picture(
            camera,
            geometry,
            options,
            Precision::Exact,
            1,
            whole(camera),
        )
        .image;
        prop_assert_eq!(&rendered(&image), &expected, "{}", method);
    }
    Ok(())
}

/// Only the small scenes; the dragon would take the reference hours.
#[test]
fn the_example_scenes_agree() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    for name in [
        "sphere",
        "triangles",
        "transforms",
        "partial-spheres",
        "quadrics",
        "instances",
    ] {
        let options = LoadOptions {
            resolution: Some([48, 27]),
            ..LoadOptions::default()
        };
        let scene = load(
            &folder.join(name).with_extension("pbrt"),
            &options,
            Progress::SILENT,
        )
        .unwrap();
        assert!(
            scene.warnings.is_empty() && scene.geometry.primitive_count() > 0,
            "{name}"
        );
        agrees_with_the_reference(&scene.camera, &scene.geometry)
            .unwrap_or_else(|wrong| panic!("{name}: {wrong}"));
    }
}

/// A triangle so close to the eye that `f32` places it at the eye, in a scene of normal size.
#[test]
fn a_triangle_too_small_for_f32_beside_the_scene() {
    for small in [-872, -160, -140, -120, -60] {
        for large in [0, 20] {
            let scaled = |corner: Corner, exponent| {
                Point::from(corner.map(|x| times_power_of_two(f64::from(x), exponent)))
            };
            let near = [[3, -1, 1], [0, 0, 0], [0, -1, 0]].map(|corner| scaled(corner, small));
            let far = [[-3, -3, -1], [0, 0, 0], [-3, -3, -1]].map(|corner| scaled(corner, large));
            let mut geometry = Geometry::default();
            add_triangles(&mut geometry, &[near, far], &Matrix::IDENTITY, 1);
            let mut world_from_camera = Matrix::scale([times_power_of_two(1.0, 28); 3]);
            for (axis, eye) in scaled([1, -1, 0], small).to_array().into_iter().enumerate() {
                world_from_camera.rows[axis][3] = eye;
            }
            let camera = grid_camera(
                world_from_camera,
                Projection::Perspective { tangent: 1.0 },
                5,
            );
            assert_eq!(
                judged(&camera, &geometry)
                    .iter()
                    .filter(|pixel| pixel[0] != 0)
                    .count(),
                12
            );
            agrees_with_the_reference(&camera, &geometry)
                .unwrap_or_else(|wrong| panic!("2^{small}, 2^{large}: {wrong}"));
        }
    }
}

proptest! {
    #![proptest_config(cases(1500))]

    /// Small integers cause ties, shared edges, and rays through vertices and along planes.
    #[test]
    fn on_integer_grids(
        triangles in prop::collection::vec(prop::array::uniform3(corner(3)), 0..12),
        balls in prop::collection::vec(grid_ball(), 0..3),
        patches in prop::collection::vec(prop::array::uniform4(corner(3)), 0..4),
        eye in corner(5),
        projection in projection(),
    ) {
        let mut geometry = Geometry::default();
        for patch in &patches {
            geometry.add_patch(patch.map(point), &Matrix::IDENTITY, 1).unwrap();
        }
        let corners = triangles.iter().map(|triangle| triangle.map(point));
        let corners: Vec<[Point; 3]> = corners.collect();
        let (first, second) = corners.split_at(corners.len() / 2);
        add_triangles(&mut geometry, first, &Matrix::IDENTITY, 1);
        balls.iter().zip(2..).for_each(|(ball, shape)| ball.add_to(&mut geometry, shape));
        add_triangles(&mut geometry, second, &Matrix::IDENTITY, 9);
        let camera = grid_camera(Matrix::translate(eye.map(f64::from)), projection, 5);
        agrees_with_the_reference(&camera, &geometry)?;
    }

    /// The same under matrices that round, so that rays miss or hit by one or two roundings.
    #[test]
    fn under_random_transforms(
        triangles in prop::collection::vec(prop::array::uniform3(corner(2)), 0..8),
        balls in prop::collection::vec(grid_ball(), 0..3),
        patches in prop::collection::vec(prop::array::uniform4(corner(2)), 0..4),
        world_from_object in matrix(),
        eye in corner(4),
        projection in projection(),
        moves_camera in any::<bool>(),
    ) {
        let mut geometry = Geometry::default();
        for patch in &patches {
            geometry.add_patch(patch.map(point), &world_from_object, 1).unwrap();
        }
        let corners = triangles.iter().map(|triangle| triangle.map(point));
        let corners: Vec<[Point; 3]> = corners.collect();
        add_triangles(&mut geometry, &corners, &world_from_object, 1);
        for (ball, shape) in balls.iter().zip(2..) {
            let world_from_object = world_from_object.times(&ball.world_from_object);
            Ball { world_from_object, ..ball.clone() }.add_to(&mut geometry, shape);
        }
        // Up to roundings, the camera in the same space sees the grid.
        let eye = Matrix::translate(eye.map(f64::from));
        let world_from_camera = if moves_camera { world_from_object.times(&eye) } else { eye };
        agrees_with_the_reference(&grid_camera(world_from_camera, projection, 5), &geometry)?;
    }

    /// Every shape and the camera have their own units, from less than 1e-300 to more than 1e300.
    #[test]
    fn at_any_scale(
        triangles in prop::collection::vec((prop::array::uniform3(corner(3)), 0usize..3), 0..6),
        patches in prop::collection::vec((prop::array::uniform4(corner(3)), 0usize..3), 0..3),
        balls in prop::collection::vec((grid_ball(), 0usize..3), 0..3),
        // Mostly scales that the rasterizer can handle, and those around its limits.
        base in prop_oneof![-1040i32..1010, -50i32..50, -50i32..50],
        offsets in prop::array::uniform3(-1.0f64..1.0),
        spread in prop::sample::select(vec![0.0, 0.0, 20.0, 100.0, 200.0, 2000.0]),
        uneven in any::<bool>(),
        camera_exponent in prop_oneof![Just(0), -50i32..50, Just(-300), Just(900)],
        eye in corner(4),
        distance in prop::sample::select(vec![0, 0, 150, 900]),
        projection in projection(),
    ) {
        let exponent = |k: usize| (base + (offsets[k] * spread) as i32).clamp(-1040, 1010);
        let mut geometry = Geometry::default();
        for (triangle, unit) in &triangles {
            let scaled = |x: i32| times_power_of_two(f64::from(x), exponent(*unit));
            let corners = triangle.map(|corner| Point::from(corner.map(scaled)));
            add_triangles(&mut geometry, &[corners], &Matrix::IDENTITY, 1);
        }
        for (patch, unit) in &patches {
            let scaled = |x: i32| times_power_of_two(f64::from(x), exponent(*unit));
            let corners = patch.map(|corner| Point::from(corner.map(scaled)));
            geometry.add_patch(corners, &Matrix::IDENTITY, 1).unwrap();
        }
        for ((ball, unit), shape) in balls.iter().zip(2..) {
            // Optionally another scale for each axis.
            let size = |k: usize| times_power_of_two(1.0, exponent(if uneven { k } else { *unit }));
            let scale = Matrix::scale([size(0), size(1), size(2)]);
            let world_from_object = scale.times(&ball.world_from_object);
            Ball { world_from_object, ..ball.clone() }.add_to(&mut geometry, shape);
        }
        let size = times_power_of_two(1.0, exponent(0));
        let camera_exponent = (exponent(0) + camera_exponent).clamp(-1040, 1010);
        let directions = times_power_of_two(1.0, camera_exponent);
        let scale = Matrix::scale([directions; 3]);
        let mut world_from_camera = scale;
        for k in 0..3 {
            world_from_camera.rows[k][3] = f64::from(eye[k]) * size;
        }
        if projection == Projection::Orthographic && distance > 0 {
            // So far away that the distance exceeds f32.
            let distance = (exponent(0) + distance).min(1010);
            world_from_camera.rows[2][3] = -times_power_of_two(1.0, distance);
        }
        agrees_with_the_reference(&grid_camera(world_from_camera, projection, 5), &geometry)?;
    }

    /// Slivers, needles and planes seen edge-on, near the eye and far from the origin.
    #[test]
    fn slivers_and_offsets(
        corners in prop::collection::vec(
            (prop::array::uniform3(corner(3)), -60i32..0, corner(2)),
            1..8,
        ),
        offset in prop::array::uniform3(
            prop::sample::select(vec![0.0, 0.1, 4.2e5, -5.4e6, 1e8, 1e15])),
        eye in corner(3),
        projection in projection(),
    ) {
        let sliver = |(triangle, thinness, off): &([Corner; 3], i32, Corner)| {
            let [a, b, _] = triangle.map(point);
            // The third corner almost lies on the edge between the first two.
            let middle = |k: usize| 0.5 * (a[k] + b[k]) + f64::from(off[k]) * 2f64.powi(*thinness);
            [a, b, Point::new(middle(0), middle(1), middle(2))]
        };
        let mut geometry = Geometry::default();
        let slivers: Vec<[Point; 3]> = corners.iter().map(sliver).collect();
        let whole = corners.iter().map(|(triangle, ..)| triangle.map(point));
        let whole: Vec<[Point; 3]> = whole.collect();
        add_triangles(&mut geometry, &slivers, &Matrix::translate(offset), 1);
        add_triangles(&mut geometry, &whole, &Matrix::translate(offset), 2);
        let eye = Matrix::translate(offset).times(&Matrix::translate(eye.map(f64::from)));
        agrees_with_the_reference(&grid_camera(eye, projection, 5), &geometry)?;
    }
}
