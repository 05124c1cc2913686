//! Surfaces that textures cut holes into: every accelerator, SIMD level and number of threads
//! against the reference, and against formulas.
//!
//! `FEIMOS_CASES=10000 cargo test --release --test alpha` runs that many cases of each kind.

#[path = "../common/mod.rs"]
mod common;
mod depths;
mod images;
mod leaves;
mod random;
mod scenes;

use common::{agreed_picture, cases, judged, picture, rendered, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::camera::{Camera, Projection, ScreenWindow};
use feimos::film::{ChannelName, PixelBounds};
use feimos::geometry::Matrix;
use proptest::prelude::*;
use random::{World, shells, world};

/// A camera whose rays pass through the points of an integer grid.
fn grid_camera(eye: [i32; 3], is_orthographic: bool, size: u32) -> Camera {
    let half = f64::from(size) / 2.0;
    Camera {
        world_from_camera: Matrix::translate(eye.map(f64::from)),
        projection: match is_orthographic {
            true => Projection::Orthographic,
            false => Projection::Perspective { tangent: 0.5 },
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

fn eye() -> impl Strategy<Value = [i32; 3]> {
    (prop::array::uniform2(-2i32..3), -7i32..1).prop_map(|([x, y], z)| [x, y, z])
}

proptest! {
    #![proptest_config(cases(120))]

    /// All accelerators, SIMD levels, threads and leaf sizes give the picture of the reference.
    #[test]
    fn every_way_agrees_with_the_reference(
        world in world(),
        eye in eye(),
        is_orthographic in any::<bool>(),
    ) {
        let (camera, geometry) = (grid_camera(eye, is_orthographic, 7), world.geometry());
        let image = agreed_picture(&camera, &geometry, Precision::Exact).image;
        prop_assert_eq!(rendered(&image), judged(&camera, &geometry));
    }

    /// A ray may meet the near side of one of several equal surfaces, and the far side of another.
    #[test]
    fn equal_surfaces_with_other_holes_agree(
        world in shells(),
        eye in eye(),
        is_orthographic in any::<bool>(),
    ) {
        let (camera, geometry) = (grid_camera(eye, is_orthographic, 7), world.geometry());
        let expected = judged(&camera, &geometry);
        for method in [SplitMethod::None, SplitMethod::Sah] {
            let options = BuildOptions { method, max_leaf: 1 };
            let window = whole(&camera);
            let found = picture(&camera, &geometry, options, Precision::Exact, 1, window);
            prop_assert_eq!(rendered(&found.image), &expected[..], "{}", method);
        }
    }

    #[test]
    fn fast_hits_do_not_depend_on_the_tree(
        world in world(),
        eye in eye(),
        is_orthographic in any::<bool>(),
    ) {
        agreed_picture(&grid_camera(eye, is_orthographic, 7), &world.geometry(), Precision::Fast);
    }

    /// A crop shows the pixels of the whole picture, and instances those of shapes written out.
    #[test]
    fn crops_and_instances_show_the_same(
        world in world(),
        eye in eye(),
        corner in prop::array::uniform2(0u32..20),
    ) {
        use ChannelName::{A, Id, Prim, T, U, V, Z};
        let (camera, geometry) = (grid_camera(eye, true, 23), world.geometry());
        let options = BuildOptions::new(SplitMethod::Sah);
        let render = |geometry: &_, window| {
            picture(&camera, geometry, options, Precision::Exact, 2, window).image
        };
        let all = render(&geometry, whole(&camera));
        let [x, y] = corner;
        let window = PixelBounds { x0: x, x1: 23, y0: y, y1: 23 };
        let crop = render(&geometry, window);
        let bits = |image: &_, name| common::bits_of(image, name);
        for name in [Z, T, A, Id, Prim, U, V] {
            let whole = bits(&all, name);
            let part = |row: &[u32]| row[x as usize..].to_vec();
            let rows = whole.chunks(23).skip(y as usize).flat_map(part);
            prop_assert_eq!(rows.collect::<Vec<_>>(), bits(&crop, name), "{}", name);
        }
        let plain = World { is_instanced: false, ..world };
        let written_out = render(&plain.geometry(), whole(&camera));
        for name in [Z, T, A, Prim, U, V] {
            prop_assert_eq!(bits(&all, name), bits(&written_out, name), "{}", name);
        }
    }
}
