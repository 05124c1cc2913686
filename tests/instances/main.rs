//! Tests that object instances give the image of the same shapes written out, and that of the
//! reference, under any transforms.
//!
//! `FEIMOS_CASES=10000 cargo test --release --test instances` runs that many cases of each kind.

#[path = "../common/mod.rs"]
mod common;
mod many;
mod world;

use common::{agreed_picture, assert_same, cases, judged, picture, rendered, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::camera::{Camera, Projection, ScreenWindow};
use feimos::exact::times_power_of_two;
use feimos::film::{ChannelName, Image};
use feimos::geometry::Matrix;
use proptest::prelude::*;
use world::{Item, eye, world};

fn camera(eye: Matrix, orthographic: bool, size: u32) -> Camera {
    let half = if orthographic { 6.0 } else { 1.0 };
    Camera {
        world_from_camera: eye,
        projection: if orthographic {
            Projection::Orthographic
        } else {
            Projection::Perspective { tangent: 1.0 }
        },
        screen_window: ScreenWindow {
            x0: -half,
            x1: half,
            y0: -half,
            y1: half,
        },
        resolution: [size, size],
    }
}

/// Drops the channel that only instances have, and the normals, whose side depends on whether the
/// shape or the instance is mirrored.
fn without_instance(mut image: Image) -> Image {
    use ChannelName::{Instance, Nx, Ny, Nz};
    image
        .channels
        .retain(|channel| ![Instance, Nx, Ny, Nz].contains(&channel.name));
    image
}

proptest! {
    #![proptest_config(cases(150))]

    /// Compares all accelerators, SIMD levels and numbers of threads with the shapes written out.
    #[test]
    fn instances_equal_shapes_written_out(
        world in world(),
        eye in eye(),
        orthographic in any::<bool>(),
    ) {
        let camera = camera(eye, orthographic, 17);
        let image = agreed_picture(&camera, &world.instanced(), Precision::Exact).image;
        let options = BuildOptions::new(SplitMethod::Sah);
        let (written_out, window) = (world.written_out(), whole(&camera));
        let expected = picture(&camera, &written_out, options, Precision::Exact, 1, window).image;
        assert_same(&without_instance(expected), &without_instance(image), "written out");
    }

    #[test]
    fn fast_hits_do_not_depend_on_the_tree(
        world in world(),
        eye in eye(),
        orthographic in any::<bool>(),
    ) {
        agreed_picture(&camera(eye, orthographic, 9), &world.instanced(), Precision::Fast);
    }

    #[test]
    fn the_reference_agrees(
        world in world(),
        eye in eye(),
        orthographic in any::<bool>(),
    ) {
        let (camera, geometry) = (camera(eye, orthographic, 7), world.instanced());
        for method in [SplitMethod::None, SplitMethod::Sah] {
            let options = BuildOptions { method, max_leaf: 1 };
            let window = whole(&camera);
            let image = picture(&camera, &geometry, options, Precision::Exact, 1, window).image;
            prop_assert_eq!(rendered(&image), judged(&camera, &geometry));
        }
    }

    /// Numbers leave the range of f64, or nearly, on the way to the instance, although the product
    /// of both transforms does not.
    #[test]
    fn scales_that_cancel_equal_shapes_written_out(
        world in world(),
        exponents in prop::array::uniform3(-1060i32..1000),
        eye in eye(),
        orthographic in any::<bool>(),
    ) {
        let scale = |exponent: i32| Matrix::scale([times_power_of_two(1.0, exponent); 3]);
        let mut world = world;
        for (object, exponent) in world.objects.iter_mut().zip(exponents) {
            object.iter_mut().for_each(|(_, matrix)| *matrix = scale(exponent).times(matrix));
        }
        for item in &mut world.items {
            if let Item::Instance(object, matrix) = item {
                *matrix = matrix.times(&scale(-exponents[*object]));
            }
        }
        let camera = camera(eye, orthographic, 9);
        let image = agreed_picture(&camera, &world.instanced(), Precision::Exact).image;
        let options = BuildOptions::new(SplitMethod::Sah);
        let (written_out, window) = (world.written_out(), whole(&camera));
        let expected = picture(&camera, &written_out, options, Precision::Exact, 1, window).image;
        assert_same(&without_instance(expected), &without_instance(image), "written out");
    }
}
