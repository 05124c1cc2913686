//! Discs cut out of squares, and leaves in front of leaves.

use crate::common::{bits_of, picture, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::film::{ChannelName, Image};
use feimos::scene::{LoadOptions, Scene, load};
use image::{GrayImage, Luma};
use std::fs;
use std::path::Path;

/// The texels of the side of an image.
const SIDE: u32 = 64;

/// Writes an image of a disc of 255 that fills it, on 0.
fn write_disc(path: &Path) {
    let middle = f64::from(SIDE) / 2.0;
    let image = GrayImage::from_fn(SIDE, SIDE, |x, y| {
        let [x, y] = [x, y].map(|at| f64::from(at) + 0.5 - middle);
        Luma([if x * x + y * y <= middle * middle {
            255
        } else {
            0
        }])
    });
    image.save(path).unwrap();
}

fn loaded(folder: &Path, world: &str) -> Scene {
    let text = format!(
        "LookAt 0 0 -4  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 40 \
         Film \"image\" \"integer xresolution\" 96 \"integer yresolution\" 96 WorldBegin {world}"
    );
    let path = folder.join("scene.pbrt");
    fs::write(&path, text).unwrap();
    let silent = feimos::progress::Progress::SILENT;
    let scene = load(&path, &LoadOptions::default(), silent);
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    scene
}

fn rendered(scene: &Scene) -> Image {
    let options = BuildOptions::new(SplitMethod::Sah);
    let (camera, geometry) = (&scene.camera, &scene.geometry);
    picture(
        camera,
        geometry,
        options,
        Precision::Exact,
        2,
        whole(camera),
    )
    .image
}

const DISC: &str = "Texture \"disc\" \"float\" \"imagemap\" \"string filename\" \"disc.png\"\n";

/// A square around the origin, with corners at -1 and 1.
const SQUARE: &str = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \
     \"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0] \"point2 uv\" [0 0 1 0 1 1 0 1]";

/// A square whose texture cuts a disc out, seen at 64 angles, is the disc of the formula, but for
/// pixels within a texel of its edge.
#[test]
fn a_square_with_the_texture_of_a_disc_is_a_disc() {
    let folder = tempfile::tempdir().unwrap();
    write_disc(&folder.path().join("disc.png"));
    let texel = 2.0 / f64::from(SIDE);
    for angle in 0..64 {
        let degrees = f64::from(angle) * 5.625 + 1.0;
        let turn = format!("Rotate {degrees} 1 2 0.5 ");
        let scene = loaded(
            folder.path(),
            &format!("{DISC}{turn}{SQUARE} \"texture alpha\" \"disc\""),
        );
        let disc = |radius: f64| {
            let shape = format!("{turn}Shape \"disk\" \"float radius\" {radius}");
            rendered(&loaded(folder.path(), &shape))
        };
        let (inner, outer) = (disc(1.0 - 1.5 * texel), disc(1.0 + 1.5 * texel));
        let found = rendered(&scene);
        let [found, inner, outer] =
            [&found, &inner, &outer].map(|image| bits_of(image, ChannelName::Z));
        let infinite = f32::INFINITY.to_bits();
        for (pixel, z) in found.iter().enumerate() {
            let must = inner[pixel] != infinite;
            let may = outer[pixel] != infinite;
            assert!(
                !must || *z == inner[pixel],
                "{degrees} degrees, pixel {pixel}: {z:x} within the disc"
            );
            assert!(
                may || *z == infinite,
                "{degrees} degrees, pixel {pixel}: {z:x} outside of the disc"
            );
        }
    }
}

/// Two leaves, one behind the other: through the holes of the nearer one, rays see the farther one,
/// in whatever order the file has them.
#[test]
fn leaves_are_seen_through_leaves_in_both_orders() {
    let folder = tempfile::tempdir().unwrap();
    write_disc(&folder.path().join("disc.png"));
    let leaf = |z: f64, shift: f64| {
        format!(
            "AttributeBegin Translate {shift} 0 {z} {SQUARE} \"texture alpha\" \"disc\" \
             AttributeEnd\n"
        )
    };
    let (near, far) = (leaf(-0.5, 0.3), leaf(0.5, -0.3));
    let image = |world: &str| rendered(&loaded(folder.path(), &format!("{DISC}{world}")));
    let [near_alone, far_alone] = [&near, &far].map(|leaf| image(leaf));
    let z = |image: &Image| bits_of(image, ChannelName::Z);
    let expected: Vec<u32> = z(&near_alone)
        .iter()
        .zip(z(&far_alone))
        .map(|(near, far)| (*near).min(far))
        .collect();
    for world in [format!("{near}{far}"), format!("{far}{near}")] {
        assert_eq!(z(&image(&world)), expected);
    }
    let ids = bits_of(&image(&format!("{near}{far}")), ChannelName::Id);
    assert!(
        (0..3).all(|id| ids.contains(&id)),
        "both are seen, and past both"
    );
}

/// Away from edges, `f32` sees the same holes.
#[test]
fn fast_hits_have_the_same_holes() {
    let folder = tempfile::tempdir().unwrap();
    write_disc(&folder.path().join("disc.png"));
    let board = "Texture \"b\" \"float\" \"checkerboard\" \"float uscale\" 9 \"float vscale\" 7\n";
    let quad = format!("Rotate 20 1 1 0 {SQUARE} \"texture alpha\" \"disc\"\n");
    let scene = loaded(
        folder.path(),
        &format!("{DISC}{board}{quad} Shape \"sphere\" \"texture alpha\" \"b\""),
    );
    let (camera, geometry) = (&scene.camera, &scene.geometry);
    let options = BuildOptions::new(SplitMethod::Sah);
    let fast = picture(camera, geometry, options, Precision::Fast, 2, whole(camera)).image;
    let exact = rendered(&scene);
    let [fast, exact] = [&fast, &exact].map(|image| bits_of(image, ChannelName::Id));
    let differ = fast.iter().zip(&exact).filter(|(a, b)| a != b).count();
    assert!(differ < 20, "{differ} pixels differ");
    assert!((0..3).all(|id| exact.contains(&id)));
}

/// The far side of a sphere is seen through the holes of the near side.
#[test]
fn the_far_side_of_a_sphere_is_seen_through_its_near_side() {
    let folder = tempfile::tempdir().unwrap();
    let board = "Texture \"b\" \"float\" \"checkerboard\" \"float uscale\" 16 \"float vscale\" 8\n";
    let sphere = "Shape \"sphere\" ";
    let holes = rendered(&loaded(
        folder.path(),
        &format!("{board}{sphere} \"texture alpha\" \"b\""),
    ));
    let solid = rendered(&loaded(folder.path(), sphere));
    let point = holes.measures(ChannelName::Pz).unwrap();
    let depth = holes.measures(ChannelName::Z).unwrap();
    for (z, point) in depth.iter().zip(point).filter(|(z, _)| z.is_finite()) {
        assert!(
            (point + 4.0 - z).abs() < 1e-5,
            "the point at {z} is {point}"
        );
    }
    let [holes, solid] = [&holes, &solid].map(|image| {
        let z = image.measures(ChannelName::Z).unwrap();
        z.to_vec()
    });
    let mut seen = [0; 3];
    for (z, front) in holes.iter().zip(&solid) {
        let place = match () {
            () if *front == f32::INFINITY => {
                assert_eq!(*z, f32::INFINITY, "nothing is beside the sphere");
                continue;
            }
            () if z == front => 0,
            // The near side ends 4 units from the eye, the far side 5.
            () if *z > 3.7 && *z <= 5.0 => 1,
            () => {
                assert_eq!(*z, f32::INFINITY);
                2
            }
        };
        seen[place] += 1;
    }
    assert!(seen.iter().all(|count| *count > 300), "{seen:?}");
}
