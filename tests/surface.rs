//! Tests the channels that describe surfaces: `N`, `P`, `u` and `v`.

mod common;

use common::{agreed_picture, assert_same, picture, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::film::{Channel, ChannelName, Image, PixelBounds};
use feimos::input::BudgetFactor;
use feimos::scene::{LoadOptions, Scene, parse};
use std::path::Path;

const SURFACE: LoadOptions = LoadOptions {
    resolution: None,
    locations: false,
    transform_history: false,
    orientation: true,
    uv: true,
    input_budget: BudgetFactor::ONCE,
};

/// Loads the scene of a text.
fn scene_of(text: &str) -> Scene {
    scene_with(text, &SURFACE)
}

fn scene_with(text: &str, options: &LoadOptions) -> Scene {
    parse(Path::new("a.pbrt"), text.as_bytes().to_vec(), options)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn image_of(scene: &Scene) -> Image {
    let options = BuildOptions::new(SplitMethod::Sah);
    picture(
        &scene.camera,
        &scene.geometry,
        options,
        Precision::Exact,
        2,
        whole(&scene.camera),
    )
    .image
}

/// A world in front of an eye at the origin that looks along z.
fn seen(world: &str) -> Scene {
    seen_by("perspective\" \"float fov\" 90", world)
}

fn seen_by(camera: &str, world: &str) -> Scene {
    let film = "Film \"image\" \"integer xresolution\" 41 \"integer yresolution\" 41";
    scene_of(&format!("Camera \"{camera} {film} WorldBegin {world}"))
}

fn measures(image: &Image, name: ChannelName) -> &[f32] {
    image.measures(name).expect("the channel asked for")
}

fn triple(image: &Image, names: [ChannelName; 3], pixel: usize) -> [f64; 3] {
    names.map(|name| f64::from(measures(image, name)[pixel]))
}

const NORMAL: [ChannelName; 3] = [ChannelName::Nx, ChannelName::Ny, ChannelName::Nz];
const POINT: [ChannelName; 3] = [ChannelName::Px, ChannelName::Py, ChannelName::Pz];
const CENTRE: usize = 20 * 41 + 20;

fn hits(image: &Image) -> Vec<usize> {
    let coverage = measures(image, ChannelName::A);
    (0..coverage.len())
        .filter(|pixel| coverage[*pixel] == 1.0)
        .collect()
}

/// Every kind of shape, cut, mirrored, reversed and instanced; a sliver, and a triangle almost
/// parallel to the rays.
const ALL_SHAPES: &str = "
    AttributeBegin Translate -2 1.5 6 Rotate 50 1 2 3
        Shape \"sphere\" \"float zmax\" 0.6 \"float phimax\" 250 AttributeEnd
    AttributeBegin Translate 1 -1 5 Scale 1.5 0.5 -0.7 ReverseOrientation
        Shape \"sphere\" AttributeEnd
    AttributeBegin Translate 2 2 6 Rotate 60 1 0 0
        Shape \"cylinder\" \"float phimax\" 300 AttributeEnd
    AttributeBegin Translate -2 -2 5 Rotate 30 1 1 0
        Shape \"disk\" \"float innerradius\" 0.3 AttributeEnd
    Shape \"trianglemesh\" \"point3 P\" [ -9 -9 12  9 -9 12  9 9 12  -9 9 11 ]
        \"integer indices\" [ 0 1 2 0 2 3 ]
        \"point2 uv\" [ 0 0  1.5 0  1.5 -1  0 -1 ]
    Shape \"trianglemesh\" \"point3 P\" [ -3 0 4  3 0.000001 4  3 0 4
        -1 -0.3 1  1 -0.3 1  0 -0.3000001 9 ] \"integer indices\" [ 0 1 2 3 4 5 ]
    ObjectBegin \"pair\"
        Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]
        AttributeBegin Scale -0.4 0.4 0.4
            Shape \"sphere\" Shape \"disk\" \"float height\" 2 AttributeEnd
    ObjectEnd
    AttributeBegin Translate 0.5 0.5 4 Rotate 20 0 1 0 ObjectInstance \"pair\" AttributeEnd
    AttributeBegin Translate -1 -1 4 Scale 0.5 0.5 -0.5 ObjectInstance \"pair\" AttributeEnd";

fn both_cameras() -> [Scene; 2] {
    let orthographic = "orthographic\" \"float screenwindow\" [ -4 4 -4 4 ]";
    [seen(ALL_SHAPES), seen_by(orthographic, ALL_SHAPES)]
}

#[test]
fn surfaces_do_not_depend_on_the_way_of_rendering() {
    for scene in both_cameras() {
        for precision in Precision::ALL {
            let image = agreed_picture(&scene.camera, &scene.geometry, precision).image;
            assert!(hits(&image).len() > 500);
            assert!(ChannelName::SURFACE.iter().all(|name| {
                measures(&image, *name)
                    .iter()
                    .all(|value| value.is_finite())
            }));
        }
    }
}

#[test]
fn crops_are_parts_of_the_whole() {
    let options = BuildOptions::new(SplitMethod::Sah);
    for Scene {
        camera, geometry, ..
    } in both_cameras()
    {
        let all = picture(
            &camera,
            &geometry,
            options,
            Precision::Exact,
            1,
            whole(&camera),
        )
        .image;
        for window in [
            PixelBounds {
                x0: 3,
                x1: 30,
                y0: 17,
                y1: 18,
            },
            PixelBounds {
                x0: 15,
                x1: 41,
                y0: 1,
                y1: 41,
            },
        ] {
            let part = picture(&camera, &geometry, options, Precision::Exact, 3, window).image;
            for Channel { name, .. } in part
                .channels
                .iter()
                .filter(|channel| channel.name.is_of_surface())
            {
                let (all, part) = (measures(&all, *name), measures(&part, *name));
                let rows = part.chunks_exact(window.width() as usize);
                for (row, y) in rows.zip(window.y0 as usize..) {
                    let of_whole = &all[41 * y + window.x0 as usize..41 * y + window.x1 as usize];
                    assert!(
                        row.iter()
                            .zip(of_whole)
                            .all(|(a, b)| a.to_bits() == b.to_bits()),
                        "{name}"
                    );
                }
            }
        }
    }
}

#[test]
fn misses_are_0() {
    let image = image_of(&seen("Translate 0 0 3 Shape \"sphere\""));
    let coverage = measures(&image, ChannelName::A);
    for pixel in (0..coverage.len()).filter(|pixel| coverage[*pixel] == 0.0) {
        assert!(
            ChannelName::SURFACE
                .iter()
                .all(|name| measures(&image, *name)[pixel].to_bits() == 0)
        );
    }
}

#[test]
fn points_agree_with_depths() {
    for Scene {
        camera, geometry, ..
    } in both_cameras()
    {
        let image = picture(
            &camera,
            &geometry,
            BuildOptions::new(SplitMethod::Sah),
            Precision::Exact,
            2,
            whole(&camera),
        )
        .image;
        for pixel in hits(&image) {
            let ray = camera.ray(pixel as u32 % 41, pixel as u32 / 41);
            let along =
                ray.origin + ray.direction * f64::from(measures(&image, ChannelName::Z)[pixel]);
            let point = triple(&image, POINT, pixel);
            let largest = along
                .to_array()
                .into_iter()
                .fold(0.0, |largest: f64, x| largest.max(x.abs()));
            assert!(
                (0..3).all(|k| (point[k] - along[k]).abs() <= 1e-6 * largest),
                "{point:?} is not {along:?}"
            );
            let length: f64 = triple(&image, NORMAL, pixel).map(|x| x * x).iter().sum();
            assert!((length - 1.0).abs() < 1e-6, "{length}");
        }
    }
}

#[test]
fn normals_of_spheres_point_along_the_radius() {
    let (centre, radius) = ([0.5, -0.25, 3.0], 1.5);
    for camera in ["perspective", "orthographic"] {
        let image = image_of(&seen_by(
            &format!("{camera}\""),
            "Translate 0.5 -0.25 3 Rotate 40 3 2 1 Shape \"sphere\" \"float radius\" 1.5",
        ));
        assert!(hits(&image).len() > 100);
        for pixel in hits(&image) {
            let (point, normal) = (triple(&image, POINT, pixel), triple(&image, NORMAL, pixel));
            let from_centre = [0, 1, 2].map(|k| point[k] - centre[k]);
            let distance = from_centre.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!((distance - radius).abs() < 1e-6 * radius, "{distance}");
            assert!(
                (0..3).all(|k| (normal[k] - from_centre[k] / radius).abs() < 4e-7),
                "{normal:?}"
            );
        }
    }
}

/// Asserts the z of the normal in the middle of the image, 1 or -1.
#[track_caller]
fn assert_normal(world: &str, expected: f64) {
    let image = image_of(&seen(world));
    assert_eq!(
        triple(&image, NORMAL, CENTRE),
        [0.0, 0.0, expected],
        "{world}"
    );
}

const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 2  1 -1 2  0 1 2 ]";
const SPHERE: &str = "Translate 0 0 3 Shape \"sphere\"";

#[test]
fn normals_of_triangles_follow_their_corners_in_mirrors() {
    assert_normal(TRIANGLE, 1.0);
    assert_normal(
        &TRIANGLE.replace("-1 -1 2  1 -1 2", "1 -1 2  -1 -1 2"),
        -1.0,
    );
    assert_normal(&format!("ReverseOrientation {TRIANGLE}"), -1.0);
    assert_normal(&format!("Scale -1 1 1 {TRIANGLE}"), 1.0);
    assert_normal(&format!("Scale -1 1 1 ReverseOrientation {TRIANGLE}"), -1.0);
    assert_normal(&format!("Scale -1 -1 1 {TRIANGLE}"), 1.0);
    let turned = TRIANGLE.replace(" 2", " -2");
    assert_normal(&format!("Scale 1 1 -1 {turned}"), -1.0);
    assert_normal(&format!("Rotate 180 0 1 0 {turned}"), -1.0);
    let bilinear = "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 2  1 -1 2  -1 1 2  1 1 2 ]";
    assert_normal(bilinear, 1.0);
    let subdivided = "Shape \"loopsubdiv\" \"integer indices\" [ 0 1 2 ] \"integer levels\" 3 \
                      \"point3 P\" [ -4 -4 2  4 -4 2  0 4 2 ]";
    // pbrt's vertex normals of a subdivision surface point against the right hand of its faces, and
    // the faces follow them.
    assert_normal(subdivided, -1.0);
    assert_normal(&format!("ReverseOrientation {subdivided}"), 1.0);
    assert_normal(&format!("Scale -1 1 1 {subdivided}"), -1.0);
    assert_normal(
        &format!("ObjectBegin \"a\" {subdivided} ObjectEnd Scale -1 1 1 ObjectInstance \"a\""),
        -1.0,
    );
}

#[test]
fn normals_of_spheres_point_outwards_except_in_mirrors() {
    assert_normal(SPHERE, -1.0);
    assert_normal(&format!("ReverseOrientation {SPHERE}"), 1.0);
    assert_normal(&format!("Scale -1 1 1 {SPHERE}"), 1.0);
    assert_normal(&format!("ReverseOrientation Scale -1 1 1 {SPHERE}"), -1.0);
    let inside = "Shape \"sphere\" \"float radius\" 4";
    assert_normal(inside, 1.0);
    let cylinder = "Translate 0 0 3 Rotate 90 1 0 0 Shape \"cylinder\"";
    assert_normal(cylinder, -1.0);
    assert_normal(&format!("ReverseOrientation {cylinder}"), 1.0);
    let disk = "Shape \"disk\" \"float height\" 2";
    assert_normal(disk, 1.0);
    assert_normal(&format!("ReverseOrientation {disk}"), -1.0);
    // Its z axis points to the eye, and its orientation is reversed.
    assert_normal("Scale 1 1 -1 Shape \"disk\" \"float height\" -2", 1.0);
    assert_normal("Rotate 180 1 0 0 Shape \"disk\" \"float height\" -2", -1.0);
}

/// pbrt's dp/du x dp/dv changes its side with the sign of the radius, except for a sphere, for
/// which it is then no normal.
#[test]
fn a_negative_radius_reverses_normals_except_for_spheres() {
    let negative = "\"float radius\" -1";
    assert_normal(&format!("{SPHERE} {negative}"), -1.0);
    let cylinder = format!("Translate 0 0 3 Rotate 90 1 0 0 Shape \"cylinder\" {negative}");
    assert_normal(&cylinder, 1.0);
    assert_normal(&format!("ReverseOrientation {cylinder}"), -1.0);
    let disk = format!("Shape \"disk\" \"float height\" 2 {negative}");
    assert_normal(&disk, -1.0);
    assert_normal(&format!("ReverseOrientation {disk}"), 1.0);
}

/// Both radii of a disk enter v with their signs: (r - distance) / (r - innerradius).
#[test]
fn v_of_a_disk_depends_on_signs() {
    let corner = 0.5f64.hypot(0.5);
    for (radius, inner) in [
        (1.0, 0.5),
        (1.0, -0.5),
        (-1.0, 0.0),
        (-1.0, 0.5),
        (-1.0, -0.5),
        (1.0, 0.0),
    ] {
        let disk = format!(
            "Translate 0 0 2 Shape \"disk\" \"float radius\" {radius} \"float innerradius\" {inner}"
        );
        let image = image_of(&seen_by(
            "orthographic\" \"float screenwindow\" [ -1.025 1.025 -1.025 1.025 ]",
            &disk,
        ));
        let v = f64::from(measures(&image, ChannelName::V)[10 * 41 + 30]);
        assert!(
            (v - (radius - corner) / (radius - inner)).abs() < 1e-6,
            "{radius} {inner}: {v}"
        );
    }
}

#[test]
fn normals_of_instances_follow_their_object() {
    let instance = |object: &str, place: &str| {
        format!(
            "ObjectBegin \"a\" {object} ObjectEnd \
             AttributeBegin {place} ObjectInstance \"a\" AttributeEnd"
        )
    };
    for place in [
        "",
        "Scale -1 1 1",
        "Scale -2 -1 1",
        "ReverseOrientation",
        "ReverseOrientation Scale -1 1 1",
    ] {
        assert_normal(&instance(TRIANGLE, place), 1.0);
        assert_normal(
            &instance(&format!("ReverseOrientation {TRIANGLE}"), place),
            -1.0,
        );
        assert_normal(&instance(&format!("Scale -1 1 1 {TRIANGLE}"), place), 1.0);
        assert_normal(&instance(SPHERE, place), -1.0);
        assert_normal(
            &instance(&format!("ReverseOrientation {SPHERE}"), place),
            1.0,
        );
        assert_normal(&instance(&format!("Scale -1 1 1 {SPHERE}"), place), 1.0);
    }
}

#[test]
fn orientation_is_reversed_within_its_block_and_in_the_world() {
    assert_normal(
        &format!("ReverseOrientation ReverseOrientation {TRIANGLE}"),
        1.0,
    );
    assert_normal(
        &format!("AttributeBegin ReverseOrientation AttributeEnd {TRIANGLE}"),
        1.0,
    );
    assert_normal(
        &format!("ReverseOrientation AttributeBegin {TRIANGLE} AttributeEnd"),
        -1.0,
    );
    assert_normal(
        &format!("ReverseOrientation AttributeBegin ReverseOrientation {TRIANGLE} AttributeEnd"),
        1.0,
    );
    let before = format!("ReverseOrientation WorldBegin {TRIANGLE}");
    let image = image_of(&scene_of(&before.replace(
        "Reverse",
        "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1 Reverse",
    )));
    assert_eq!(triple(&image, NORMAL, 0), [0.0, 0.0, 1.0]);
}

#[test]
fn surfaces_of_instances_equal_those_written_out() {
    let object = format!(
        "{TRIANGLE} AttributeBegin Scale -1 1 2 Translate 0.2 0.1 0 {SPHERE} AttributeEnd \
         ReverseOrientation Shape \"disk\""
    );
    let place = "Translate 0.3 0.2 2 Rotate 33 1 2 3 Scale 0.9 1.1 1.3";
    let instanced = format!("ObjectBegin \"a\" {object} ObjectEnd {place} ObjectInstance \"a\"");
    let [mut instanced, mut written] =
        [instanced, format!("{place} {object}")].map(|world| image_of(&seen(&world)));
    for image in [&mut instanced, &mut written] {
        image
            .channels
            .retain(|channel| channel.name != ChannelName::Instance);
    }
    assert!(hits(&written).len() > 100);
    assert_same(&written, &instanced, "written out");
}

/// A square of two triangles with different coordinates at each corner.
const P: &str = "-1 -1 2  1 -1 2  1 1 2  -1 1 2";
const UV: &str = "0 0.25  1 0.5  2 -3  -0.125 1";

#[test]
fn a_mesh_has_the_same_coordinates_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let (p, uv): (Vec<f32>, Vec<f32>) = {
        let numbers = |text: &str| {
            text.split_whitespace()
                .map(|word| word.parse().unwrap())
                .collect()
        };
        (numbers(P), numbers(UV))
    };
    let vertex = |k: usize| {
        [
            p[3 * k],
            p[3 * k + 1],
            p[3 * k + 2],
            uv[2 * k],
            uv[2 * k + 1],
        ]
    };
    let header = |encoding: &str| {
        format!(
            "ply\nformat {encoding} 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
             property float z\nproperty float s\nproperty float t\nelement face 1\n\
             property list uchar uchar vertex_indices\nend_header\n"
        )
    };
    let lines: String = (0..4)
        .map(|k| vertex(k).map(|x| x.to_string()).join(" ") + "\n")
        .collect();
    let binary = (0..4)
        .flat_map(vertex)
        .flat_map(f32::to_le_bytes)
        .chain([4, 0, 1, 2, 3]);
    let binary: Vec<u8> = header("binary_little_endian")
        .into_bytes()
        .into_iter()
        .chain(binary)
        .collect();
    let statement = |keyword: &str, size: usize, values: &[f32]| -> String {
        values
            .chunks(size)
            .map(|line| {
                format!(
                    "{keyword} {}\n",
                    line.iter()
                        .map(ToString::to_string)
                        .collect::<Vec<_>>()
                        .join(" ")
                )
            })
            .collect()
    };
    let obj = format!(
        "{}{}f 1/1 2/2 3/3 4/4\n",
        statement("v", 3, &p),
        statement("vt", 2, &uv)
    );
    for (name, bytes) in [
        (
            "a.ply",
            format!("{}{lines}4 0 1 2 3\n", header("ascii")).into_bytes(),
        ),
        ("b.ply", binary),
        ("c.obj", obj.into_bytes()),
    ] {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    let arrays = format!("\"point3 P\" [ {P} ] \"integer indices\" [ 0 1 2 0 2 3 ]");
    let expected = image_of(&seen(&format!(
        "Shape \"trianglemesh\" {arrays} \"point2 uv\" [ {UV} ]"
    )));
    let file = |kind: &str, name: &str| {
        format!(
            "Shape \"{kind}\" \"string filename\" \"{}\"",
            folder.path().join(name).display()
        )
    };
    let [a, b, c] = [
        file("plymesh", "a.ply"),
        file("plymesh", "b.ply"),
        file("objmesh", "c.obj"),
    ];
    let instanced = format!("ObjectBegin \"a\" {b} ObjectEnd ObjectInstance \"a\"");
    for world in [
        format!("Shape \"trianglemesh\" {arrays} \"float st\" [ {UV} ]"),
        a.clone(),
        b,
        c,
        instanced,
    ] {
        let image = image_of(&seen(&world));
        assert!(
            [ChannelName::U, ChannelName::V]
                .iter()
                .all(|name| measures(&image, *name) == measures(&expected, *name)),
            "{world}"
        );
    }
    // The middle of the edge between both triangles.
    assert_eq!(
        [ChannelName::U, ChannelName::V].map(|name| measures(&expected, name)[CENTRE]),
        [1.0, -1.375]
    );
    let plain = scene_with(&format!("WorldBegin {a}"), &LoadOptions::default());
    let kept = scene_with(&format!("WorldBegin {a}"), &SURFACE);
    assert!(plain.geometry.bytes() < kept.geometry.bytes());
}

#[test]
fn attributes_that_are_not_requested_are_not_kept() {
    let mirrored = "WorldBegin Scale -1 1 1 ReverseOrientation Shape \"sphere\" \
                    ReverseOrientation Shape \"disk\"";
    let bytes = |text: &str, options: &LoadOptions| scene_with(text, options).geometry.bytes();
    let arrays = format!(
        "WorldBegin Shape \"trianglemesh\" \"point3 P\" [ {P} ] \"integer indices\" [ 0 1 2 0 2 3 ]"
    );
    let with_uv = format!("{arrays} \"point2 uv\" [ {UV} ]");
    let default = LoadOptions::default();
    assert_eq!(bytes(&with_uv, &default), bytes(&arrays, &default));
    assert_eq!(bytes(&arrays, &SURFACE), bytes(&arrays, &default));
    assert!(bytes(&with_uv, &SURFACE) > bytes(&arrays, &default));
    assert!(bytes(mirrored, &SURFACE) > bytes(mirrored, &default));
}

#[test]
fn meshes_without_coordinates_get_those_of_pbrt() {
    // The corners project to the centres of pixels, at 0.8 times the half width.
    let image = image_of(&seen(
        "Shape \"trianglemesh\" \"point3 P\" [ -10 -10 10.25  10 -10 10.25  10 10 10.25 ]",
    ));
    let at = |x: usize, y: usize| {
        [ChannelName::U, ChannelName::V].map(|name| measures(&image, name)[(40 - y) * 41 + x])
    };
    assert_eq!(
        [at(0, 0), at(40, 0), at(40, 40), at(20, 20), at(30, 10)],
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 0.5], [0.75, 0.25]]
    );
    let patch = image_of(&seen(
        "Shape \"bilinearmesh\" \"point3 P\" [ -10 -10 10.25  10 -10 10.25 \
         -10 10 10.25  10 10 10.25 ]",
    ));
    for (x, y) in [(0, 0), (10, 30), (30, 10), (40, 40), (0, 40)] {
        let found =
            [ChannelName::U, ChannelName::V].map(|name| measures(&patch, name)[(40 - y) * 41 + x]);
        assert_eq!(found, [x as f32 / 40.0, y as f32 / 40.0]);
    }
}

#[test]
fn a_wrong_number_of_coordinates_is_a_warning() {
    for (uv, found) in [
        (
            "point2 uv\" [ 0 0 1 0 ]",
            "`uv` has 4 numbers, expected two a vertex: 6; they are ignored",
        ),
        (
            "float st\" [ 0 0 1 0 1 1 2 ]",
            "`st` has 7 numbers, expected two a vertex: 6; the rest are dropped",
        ),
    ] {
        let text =
            format!("WorldBegin\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"{uv}");
        let scene = parse(Path::new("a.pbrt"), text.clone().into_bytes(), &SURFACE).unwrap();
        let said: Vec<String> = scene
            .warnings
            .iter()
            .map(|warning| warning.first.to_string())
            .collect();
        assert!(
            said.len() == 1 && said[0].starts_with("a.pbrt:2:") && said[0].contains(found),
            "{said:?}"
        );
        assert_eq!(scene.geometry.triangle_count(), 1);
        let without = parse(
            Path::new("a.pbrt"),
            text.into_bytes(),
            &LoadOptions::default(),
        )
        .unwrap();
        assert!(without.warnings.is_empty());
    }
}
