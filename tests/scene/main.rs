//! What scene files mean: cameras, transforms, shapes, and what is said about mistakes.

mod blocks;
mod continued;
mod directives;
mod materials;
mod matrices;
mod names;
mod parameters;

use feimos::error::ErrorKind;
use feimos::film::PixelBounds;
use feimos::geometry::{Matrix, Point};
use feimos::input::BudgetFactor;
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, Scene, load, read_options};
use feimos::shape::{Form, Instance, InstancedId, PrimitiveId};
use std::path::Path;
use tempfile::TempDir;

/// A folder with files in it; the first one is loaded.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    folder
}

fn load_files(files: &[(&str, &str)]) -> Result<Scene, String> {
    load_folder(&folder(files), files[0].0)
}

fn load_folder(folder: &TempDir, name: &str) -> Result<Scene, String> {
    let path = folder.path().join(name);
    let root = format!("{}/", folder.path().display());
    load(&path, &LoadOptions::default(), Progress::SILENT)
        .map_err(|error| error.to_string().replace(&root, ""))
}

fn scene(text: &str) -> Scene {
    load_files(&[("a.pbrt", text)]).unwrap_or_else(|error| panic!("{error}"))
}

fn error(text: &str) -> String {
    load_files(&[("a.pbrt", text)]).unwrap_err()
}

/// The error, or the first warning of a scene that has one shape less than it could.
fn complaint(text: &str) -> String {
    let folder = folder(&[("a.pbrt", text)]);
    let root = format!("{}/", folder.path().display());
    match load(
        &folder.path().join("a.pbrt"),
        &LoadOptions::default(),
        Progress::SILENT,
    ) {
        Ok(scene) => scene
            .warnings
            .iter()
            .next()
            .expect("a warning")
            .first
            .to_string()
            .replace(&root, ""),
        Err(error) => error.to_string().replace(&root, ""),
    }
}

/// Messages of the warnings without their places, and how often each applied.
fn warnings(scene: &Scene) -> Vec<(String, u64)> {
    scene
        .warnings
        .iter()
        .map(|warning| (warning.first.message.clone(), warning.count))
        .collect()
}

fn vertex(scene: &Scene, index: usize) -> [f64; 3] {
    scene.geometry.vertices()[index].to_array()
}

const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ]\n";

/// Rays that pbrt-v3 printed, in single precision and with directions of length 1.
#[test]
fn cameras_are_those_of_pbrt() {
    let rows = include_str!("../pbrt3-camera-rays.tsv")
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1);
    let mut count = 0;
    for row in rows {
        let columns: Vec<&str> = row.split('\t').collect();
        let number = |column: usize| columns[column].parse::<f64>().unwrap();
        let film = format!(
            "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}",
            columns[2], columns[3]
        );
        let camera = scene(&format!(
            "{}\n{}\n{film}\nWorldBegin",
            columns[0], columns[1]
        ))
        .camera;
        let ray = camera.ray(number(4) as u32, number(5) as u32);
        let direction = ray.direction.normalized();
        for axis in 0..3 {
            assert!(
                (ray.origin[axis] - number(6 + axis)).abs() < 2e-5,
                "{row}: {:?}",
                ray.origin
            );
            assert!(
                (direction[axis] - number(9 + axis)).abs() < 2e-6,
                "{row}: {direction:?}"
            );
        }
        count += 1;
    }
    assert_eq!(count, 15);
}

#[test]
fn a_scale_before_look_at_mirrors_the_view() {
    let plain = scene("LookAt 0 0 -5  0 0 0  0 1 0  Camera \"perspective\" WorldBegin").camera;
    let mirrored =
        scene("Scale -1 1 1  LookAt 0 0 -5  0 0 0  0 1 0  Camera \"perspective\" WorldBegin")
            .camera;
    let [width, _] = plain.resolution;
    assert_eq!(
        plain.ray(3, 5).direction,
        mirrored.ray(width - 1 - 3, 5).direction
    );
    let after =
        scene("LookAt 0 0 -5  0 0 0  0 1 0  Scale 2 2 2  Camera \"perspective\" WorldBegin").camera;
    assert_eq!(
        after.anchor(),
        Point::new(0.0, 0.0, -2.5),
        "the world is twice as large, so the eye is half as far"
    );
}

#[test]
fn without_camera_and_film_pbrts_defaults_hold() {
    let scene = scene("WorldBegin");
    assert_eq!(scene.film.resolution, [1280, 720]);
    assert_eq!(scene.camera.ray(639, 359).direction.z, 1.0);
    assert_eq!((scene.film.filename, scene.accelerator.name), (None, None));
}

#[test]
fn camera_parameters() {
    let camera = |parameters: &str| {
        let film = "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 2";
        scene(&format!(
            "Camera \"perspective\" {parameters}\n{film}\nWorldBegin"
        ))
        .camera
    };
    assert_eq!(
        camera("\"float halffov\" 45")
            .ray(3, 0)
            .direction
            .to_array(),
        [1.5, 0.5, 1.0]
    );
    assert_eq!(
        camera("\"float halffov\" 45 \"float fov\" 10")
            .ray(3, 0)
            .direction
            .to_array(),
        [1.5, 0.5, 1.0]
    );
    for half in ["0", "-1", "-45"] {
        // pbrt's value for "not there" is -1, and it takes what is above 0.
        let found = camera(&format!("\"float halffov\" {half} \"float fov\" 90"));
        assert_eq!(
            found.ray(3, 0).direction.to_array(),
            [1.5, 0.5, 1.0],
            "{half}"
        );
    }
    assert_eq!(
        camera("\"float frameaspectratio\" 1")
            .ray(3, 0)
            .direction
            .to_array(),
        [0.75, 0.5, 1.0]
    );
    let window = camera("\"float screenwindow\" [ 0 8 0 4 ] \"float fov\" 90");
    assert_eq!(window.ray(3, 0).direction.to_array(), [7.0, 3.0, 1.0]);
}

#[test]
fn film_parameters() {
    let film = |parameters: &str| scene(&format!("Film \"rgb\" {parameters} WorldBegin")).film;
    let small = "\"integer xresolution\" 7 \"integer yresolution\" [ 5 ]";
    let cropped = film(&format!(
        "{small} \"float cropwindow\" [ 0.3 1 0 0.5 ] \"string filename\" \"out/a.exr\""
    ));
    assert_eq!(
        cropped.crop,
        PixelBounds {
            x0: 3,
            x1: 7,
            y0: 0,
            y1: 3
        }
    );
    assert_eq!(cropped.filename.as_deref(), Some("out/a.exr"));
    let bounds = film(&format!("{small} \"integer pixelbounds\" [ 1 3 0 99 ]"));
    assert_eq!(
        bounds.crop,
        PixelBounds {
            x0: 1,
            x1: 3,
            y0: 0,
            y1: 5
        }
    );
}

#[test]
fn transforms_nest_and_are_restored() {
    let scene = scene(&format!(
        "WorldBegin
        Translate 1 0 0
        AttributeBegin Scale 2 2 2 TransformBegin Rotate 90 0 0 1 {TRIANGLE} TransformEnd {TRIANGLE} AttributeEnd
        {TRIANGLE}
        CoordinateSystem \"here\" Identity {TRIANGLE} CoordSysTransform \"here\" {TRIANGLE}
        ConcatTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  0 0 7 1 ] {TRIANGLE}
        Transform 1 0 0 0  0 1 0 0  0 0 1 0  0 0 7 1 {TRIANGLE}"
    ));
    let second_corners: Vec<[f64; 3]> = (0..7).map(|k| vertex(&scene, 3 * k + 1)).collect();
    let expected = [
        [1., 2., 0.],
        [3., 0., 0.],
        [2., 0., 0.],
        [1., 0., 0.],
        [2., 0., 0.],
        [2., 0., 7.],
        [1., 0., 7.],
    ];
    assert_eq!(second_corners, expected);
    assert_eq!(
        (scene.shape_count, scene.transform_count),
        (7, 6),
        "two shapes share `Translate 1 0 0`"
    );
}

#[test]
fn the_cameras_coordinate_system_moves_with_it() {
    let scene = scene(&format!(
        "LookAt 0 0 -5  0 0 0  0 1 0  Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" {TRIANGLE}"
    ));
    assert_eq!(vertex(&scene, 1), [1.0, 0.0, -5.0]);
}

#[test]
fn mirrored_meshes_keep_their_places() {
    let scene = scene(&format!(
        "WorldBegin Scale -1 1 1 ReverseOrientation {TRIANGLE}"
    ));
    assert_eq!(
        (vertex(&scene, 1), vertex(&scene, 2)),
        ([-1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    );
    assert_eq!(warnings(&scene), []);
}

#[test]
fn spellings_of_both_versions() {
    let scene = scene(
        "Integrator \"path\" Camera \"perspective\" \"float fov\" [ 40 ]
        ColorSpace \"srgb\" Option \"bool disablepixeljitter\" true
        WorldBegin
        Material \"diffuse\" \"rgb reflectance\" [ 1 0 0 ]
        Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"t.png\"
        Shape \"trianglemesh\" \"point P\" [ 0,0,0  1,0,0  0,1,.5 ] \"integer indices\" [ 0 1 2 ] # v3
        Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1e0 +5E-1 ] \"point2 uv\" [ 0 0  1 0  0 1 ]
        MakeNamedMaterial \"m\" \"string type\" \"matte\"",
    );
    assert_eq!(vertex(&scene, 2), vertex(&scene, 5));
    assert_eq!(warnings(&scene), []);
    let summary = "skipped, without influence on hit and depth: 1 ColorSpace, 1 Integrator, 1 MakeNamedMaterial, \
                   1 Material, 1 Option, 1 Texture";
    assert_eq!(scene.census.summary().as_deref(), Some(summary));
}

#[test]
fn shapes_count_whether_they_are_supported_or_not() {
    let scene = scene(&format!(
        "WorldBegin {TRIANGLE} Shape \"cone\" Shape \"cone\" Shape \"sphere\" Shape \"spehre\" {TRIANGLE}"
    ));
    assert_eq!(scene.shape_count, 6);
    let geometry = &scene.geometry;
    assert_eq!(
        geometry.shape_number(InstancedId::alone(PrimitiveId::triangle(1))),
        6
    );
    let sphere = InstancedId::alone(PrimitiveId::quadric(0));
    assert_eq!(
        (geometry.shape_number(sphere), geometry.number(sphere)),
        (4, 1)
    );
    let expected = [
        "the shape `cone` is not supported: left out",
        "the shape `spehre` is not supported: left out",
    ];
    assert_eq!(
        warnings(&scene),
        [(expected[0].to_owned(), 2), (expected[1].to_owned(), 1)]
    );
    let second = scene.warnings.iter().nth(1).unwrap();
    assert_eq!(second.first.notes, ["did you mean `sphere`?"]);
}

#[test]
fn objects_are_stored_once_and_placed_by_the_transform_at_the_instance() {
    let scene = scene(&format!(
        "WorldBegin
        Translate 1 2 3
        ObjectBegin \"o\" Scale 2 2 2 {TRIANGLE} Translate 0 0 1 Shape \"sphere\" ObjectEnd
        ObjectBegin \"never shown\" {TRIANGLE} ObjectEnd
        {TRIANGLE}
        AttributeBegin Scale 1 -1 1 ObjectInstance \"o\" AttributeEnd
        ObjectInstance \"o\"
        {TRIANGLE}"
    ));
    let geometry = &scene.geometry;
    assert_eq!(
        (
            geometry.objects().len(),
            geometry.instances().len(),
            geometry.own_count()
        ),
        (1, 2, 2)
    );
    assert_eq!(
        (
            scene.shape_count,
            geometry.primitive_count(),
            warnings(&scene).len()
        ),
        (5, 6, 0)
    );
    let world_from_object = Matrix::translate([1.0, 2.0, 3.0]);
    let world_from_instance = world_from_object.times(&Matrix::scale([1.0, -1.0, 1.0]));
    let world_from_mesh =
        world_from_instance.times(&world_from_object.times(&Matrix::scale([2.0, 2.0, 2.0])));
    let triangle = geometry.placed_triangle(InstancedId::in_instance(0, PrimitiveId::triangle(0)));
    let moved_again =
        geometry.placed_triangle(InstancedId::in_instance(1, PrimitiveId::triangle(0)));
    assert_eq!(
        (triangle.0[0], moved_again.0[0].y),
        (world_from_mesh.apply(Point::new(0.0, 0.0, 0.0)), 4.0)
    );
    let ids = geometry
        .all()
        .map(|placed| (geometry.number(placed), geometry.shape_number(placed)));
    assert_eq!(
        ids.collect::<Vec<_>>(),
        [(0, 4), (5, 5), (1, 1), (2, 2), (3, 1), (4, 2)]
    );
}

#[test]
fn objects_in_the_wrong_place_are_errors() {
    let cases = [
        (
            "ObjectBegin \"o\" ObjectEnd WorldBegin",
            "ObjectBegin outside the world",
        ),
        (
            "ObjectInstance \"o\" WorldBegin",
            "ObjectInstance outside the world",
        ),
        (
            "WorldBegin ObjectBegin \"o\" ObjectInstance \"o\"",
            "an instance within an object",
        ),
        (
            "WorldBegin ObjectBegin \"o\" ObjectEnd ObjectInstance \"p\"",
            "there is no object called `p`",
        ),
    ];
    for (text, message) in cases {
        assert!(error(text).contains(message), "{text}: {}", error(text));
    }
    let misspelt = error("WorldBegin ObjectBegin \"tree\" ObjectEnd ObjectInstance \"tere\"");
    assert!(misspelt.contains("did you mean `tree`?"), "{misspelt}");
}

#[test]
fn the_object_defined_last_is_shown() {
    let scene = scene(&format!(
        "WorldBegin ObjectBegin \"o\" {TRIANGLE} ObjectEnd ObjectInstance \"o\"
        ObjectBegin \"o\" Shape \"sphere\" ObjectEnd ObjectInstance \"o\""
    ));
    let message = "a second object called `o`: instances that follow show this one";
    assert_eq!(warnings(&scene), [(message.to_owned(), 1)]);
    assert_eq!(
        scene
            .geometry
            .instances()
            .iter()
            .map(Instance::object)
            .collect::<Vec<_>>(),
        [0, 1]
    );
}

#[test]
fn what_is_rendered_otherwise_is_warned_of() {
    let scene = scene(
        "Camera \"orthographic\" \"float screenwindow\" [ 1 1 0 2 ]
        WorldBegin
        Shape \"sphere\" \"float zmin\" -1 \"float phimax\" 360
        Shape \"sphere\" \"float zmin\" -0.5 \"float radious\" 2
        Shape \"sphere\" \"float radius\" 0
        Scale 1 0 1 Shape \"sphere\"
        LookAt 0 0 0 0 1 0 0 1 0
        CoordSysTransform \"nowhere\"
        ObjectBegin \"o\" Shape \"sphere\" ObjectEnd ObjectInstance \"o\"
        Identity Translate 1e999 0 0",
    );
    let expected = [
        "the screen window has no extent: all pixels of a row or a column look the same way",
        "Shape \"sphere\" has no parameter `radious`: ignored",
        "a sphere of radius 0 is never hit",
        "a sphere under a singular or infinite transform is never hit",
        "the up vector is parallel to the view, or the eye too far away: this LookAt does nothing",
        "no coordinate system is called `nowhere`: ignored",
        "the numbers of this transform are beyond the range of f64, or no numbers",
    ];
    let counts = [1, 1, 1, 2, 1, 1, 1];
    let found: Vec<(String, u64)> = expected
        .iter()
        .map(|m| (*m).to_owned())
        .zip(counts)
        .collect();
    assert_eq!(warnings(&scene), found);
    let geometry = &scene.geometry;
    assert_eq!(
        geometry.quadric_count(),
        4,
        "those that are never hit keep their numbers"
    );
    let is_cut = |index: usize| geometry.quadric(index).form != Form::Sphere(None);
    assert_eq!([0, 1, 2, 3].map(is_cut), [false, true, false, false]);
}

#[test]
fn nothing_that_matters_is_left_out_in_silence() {
    let scene = scene(
        "Film \"image\" \"integer xresolutoin\" 64 \"float diagonal\" 35
        Accelerator \"bvh\" \"string splitmethd\" \"equal\" \"integer maxnodeprims\" 1000
        WorldBegin
        Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"texture displacement\" \"d\" \"float alpha\" 1
        Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"texture alpha\" \"leaf\"
        WorldEnd Shape \"sphere\"",
    );
    let expected = [
        "Film \"image\" has no parameter `xresolutoin`: ignored",
        "Accelerator \"bvh\" has no parameter `splitmethd`: ignored",
        "displacement is ignored: the surface stays where it is",
        "alpha is ignored: the whole surface is solid",
        "what follows WorldEnd is ignored: one world is one picture",
    ];
    assert_eq!(
        warnings(&scene),
        expected.map(|message| (message.to_owned(), 1))
    );
    assert_eq!(scene.accelerator.max_leaf, Some(255));
}

#[test]
fn misspelt_names_of_what_is_missing_are_told() {
    let message = complaint("WorldBegin Shape \"trianglemesh\" \"point3 p\" [ 0 0 0 1 0 0 0 1 0 ]");
    assert!(
        message.contains("\n   = did you mean `P` by `p`?"),
        "{message}"
    );
    let message = complaint("Camera \"perspectiv\"");
    assert!(
        message.contains("\n   = did you mean `perspective`?"),
        "{message}"
    );
}

#[test]
fn included_files_are_found_beside_the_top_level_scene() {
    let files = [
        (
            "a.pbrt",
            "WorldBegin Include \"parts/b.pbrt\" Include \"parts/b.pbrt\"",
        ),
        ("parts/b.pbrt", "Translate 1 0 0 Include \"c.pbrt\""),
        ("c.pbrt", TRIANGLE),
    ];
    let scene = load_files(&files).unwrap();
    assert_eq!(
        (vertex(&scene, 0), vertex(&scene, 3)),
        ([1.0, 0.0, 0.0], [2.0, 0.0, 0.0])
    );
    let missing = load_files(&[("a.pbrt", "WorldBegin\nInclude \"b.pbrt\"")]).unwrap_err();
    let expected = "b.pbrt: cannot read: No such file or directory (os error 2)\n   = included from a.pbrt:2:9";
    assert_eq!(missing, expected);
    let circle = [
        ("a.pbrt", "Include \"b.pbrt\""),
        ("b.pbrt", "Include \"a.pbrt\""),
    ];
    assert!(
        load_files(&circle)
            .unwrap_err()
            .starts_with("b.pbrt:1:9: a.pbrt includes itself")
    );
}

#[test]
fn includes_have_a_depth_at_most() {
    let names: Vec<String> = (0..80).map(|k| format!("{k}.pbrt")).collect();
    let texts: Vec<String> = (0..80)
        .map(|k| format!("Include \"{}.pbrt\"", k + 1))
        .collect();
    let files: Vec<(&str, &str)> = names
        .iter()
        .zip(&texts)
        .map(|(name, text)| (name.as_str(), text.as_str()))
        .collect();
    let message = load_files(&files).unwrap_err();
    assert!(
        message.starts_with("63.pbrt:1:9: more than 64 files include each other"),
        "{message}"
    );
}

#[test]
fn meshes_are_found_beside_the_scene() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let text = "WorldBegin Shape \"objmesh\" \"string filename\" \"meshes/m.obj\"";
    let scene = load_files(&[("a.pbrt", text), ("meshes/m.obj", obj)]).unwrap();
    assert_eq!(scene.geometry.triangle_count(), 1);
    let missing = load_files(&[("a.pbrt", text)]).unwrap_err();
    let expected = "meshes/m.obj: cannot read: No such file or directory (os error 2)\n   = named in a.pbrt:1:46";
    assert_eq!(missing, expected);
}

const TETRAHEDRON: &str = "\"point3 P\" [ 1 1 1  1 -1 -1  -1 1 -1  -1 -1 1 ] \"integer indices\" [ 0 1 2  0 3 1  0 2 3  1 3 2 ]";

#[test]
fn subdivision_surfaces_take_the_levels_of_v3_and_of_v4() {
    for (levels, faces) in [
        ("", 256),
        ("\"integer nlevels\" 0", 4),
        ("\"integer levels\" 1 \"integer nlevels\" 2", 16),
    ] {
        let text = format!(
            "WorldBegin Shape \"loopsubdiv\" {TETRAHEDRON} {levels} \"string scheme\" \"loop\" {TRIANGLE}"
        );
        let scene = scene(&text);
        assert_eq!(
            (scene.geometry.triangle_count(), warnings(&scene)),
            (faces + 1, vec![]),
            "{levels}"
        );
        assert_eq!(
            scene
                .geometry
                .shape_number(InstancedId::alone(PrimitiveId::triangle(faces - 1))),
            1
        );
    }
    // The first vertex halfway: (1 - 3 w) v - w v with w = 1/5.
    let scene = scene(&format!(
        "WorldBegin Translate 10 0 0 Shape \"loopsubdiv\" {TETRAHEDRON} \"integer levels\" 0"
    ));
    assert!((scene.geometry.vertices()[0] - Point::new(10.2, 0.2, 0.2)).largest() < 1e-14);
}

#[test]
fn what_cannot_be_subdivided_is_shown() {
    let cases = [
        (
            "\"integer indices\" [ 0 1 2 ]",
            "1:18: a subdivision surface without vertices",
        ),
        (
            "\"point3 P\" [ 0 0 0 ]",
            "1:18: a subdivision surface without faces",
        ),
        (
            "\"point3 P\" [ 0 0 0 ] \"integer indices\" [ 0 0 ]",
            "1:70: `indices` has 2 numbers, expected three a face",
        ),
        (
            "\"point3 P\" [ 0 0 0 ] \"integer indices\" [ 0 0 1 ]",
            "1:76: index 1, number 3 of `indices`, names no vertex",
        ),
        (
            "\"point3 P\" [ 0 0 0 ] \"integer indices\" [ 0 0 0 ]",
            "1:72: a face with vertex 0 twice",
        ),
        (
            "\"integer levels\" -1",
            "1:48: `levels` is -1, expected an integer from 0 to 30",
        ),
        (
            "\"integer nlevels\" 31",
            "1:49: `nlevels` is 31, expected an integer from 0 to 30",
        ),
    ];
    for (parameters, expected) in cases {
        let found = complaint(&format!("WorldBegin Shape \"loopsubdiv\" {parameters}"));
        assert!(found.starts_with(&format!("a.pbrt:{expected}")), "{found}");
    }
    let found = complaint(&format!(
        "WorldBegin\nShape \"loopsubdiv\" {TETRAHEDRON}\n  \"integer nlevels\" 13"
    ));
    let expected = "a.pbrt:3:21: subdivision would make 268435456 faces of the scene's 4: at most 4210688 are made of so many\n   \
        |\n 3 |   \"integer nlevels\" 13\n   |                     ^^\n   = if this is meant, raise what input files may \
        expand to: --input-budget 2\n   = else take fewer levels";
    assert_eq!(found, expected);
}

#[test]
fn bilinear_patches_are_two_triangles_each() {
    let corners = "\"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0  2 0 0  2 1 1 ]";
    let flat = scene(&format!(
        "WorldBegin Shape \"bilinearmesh\" {corners} \"integer indices\" [ 0 1 2 3 ] \"point2 uv\" [ 0 0 ]"
    ));
    assert_eq!(warnings(&flat), []);
    let triangles = [0, 1].map(|index| {
        flat.geometry
            .triangle(index)
            .0
            .map(|corner| (corner.x, corner.y))
    });
    assert_eq!(
        triangles,
        [
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)],
            [(0.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        ]
    );
    let curved = "\"integer indices\" [ 0 1 2 3  1 4 3 5 ]";
    let both = scene(&format!(
        "WorldBegin Shape \"bilinearmesh\" {corners} {curved} Shape \"bilinearmesh\" {corners} {curved}"
    ));
    assert_eq!(
        (
            both.geometry.triangle_count(),
            both.geometry
                .number(InstancedId::alone(PrimitiveId::triangle(7)))
        ),
        (8, 7)
    );
    let message =
        "bilinear patches that are not flat and convex are rendered as two triangles each";
    assert_eq!(warnings(&both), [(message.to_owned(), 2)]);
    let alone =
        scene("WorldBegin Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]");
    assert_eq!(alone.geometry.triangle_count(), 2);
    let found = complaint(&format!("WorldBegin Shape \"bilinearmesh\" {corners}"));
    assert!(
        found.starts_with("a.pbrt:1:18: a bilinear mesh of 6 vertices without `indices`"),
        "{found}"
    );
    let found = complaint(&format!(
        "WorldBegin Shape \"bilinearmesh\" {corners} \"integer indices\" [ 0 1 2 ]"
    ));
    assert!(
        found.contains("`indices` has 3 numbers, expected four a patch"),
        "{found}"
    );
}

#[test]
fn a_bare_mesh_is_framed() {
    let obj = "v -1 -1 0\nv 3 -1 0\nv 1 2 4\nf 1 2 3\n";
    let scene = load_files(&[("m.obj", obj)]).unwrap();
    let eye = scene.camera.anchor();
    assert_eq!((eye.x, eye.y), (1.0, 0.5));
    assert!(eye.z > 4.0);
    let floor = load_files(&[("m.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n")]).unwrap();
    assert!(
        floor.camera.anchor().y > 0.5,
        "a flat mesh is not seen along its edge"
    );
    let empty = load_files(&[("m.obj", "# nothing\n")]).unwrap();
    assert_eq!(
        (empty.geometry.triangle_count(), warnings(&empty).len()),
        (0, 1)
    );
}

#[test]
fn mistakes_of_order() {
    assert!(error("Shape \"sphere\"").starts_with("a.pbrt:1:1: Shape outside the world"));
    assert!(
        error("WorldBegin Camera \"perspective\"")
            .starts_with("a.pbrt:1:12: Camera inside the world")
    );
    assert!(error("WorldBegin WorldBegin").starts_with("a.pbrt:1:12: a second WorldBegin"));
    assert!(error("Scale 1 1 1").starts_with("a.pbrt: the scene has no WorldBegin"));
}

#[test]
fn mistakes_of_value() {
    let cases = [
        (
            "Camera \"perspective\" \"float fov\" 180",
            "a.pbrt:1:34: a field of view of 180 degrees",
        ),
        (
            "Camera \"perspective\" \"float fov\" [ 1 2 ]",
            "a.pbrt:1:34: `fov` takes one number, found 2",
        ),
        (
            "Camera \"spherical\"",
            "a.pbrt:1:8: the camera `spherical` is not supported",
        ),
        (
            "Scale 0 1 1 Camera \"perspective\"",
            "a.pbrt:1:1: this Scale by 0 cannot be undone",
        ),
        (
            "LookAt 1 1 1 1 1 1 0 1 0 Camera \"perspective\"",
            "a.pbrt:1:1: this LookAt has no direction",
        ),
        (
            "Rotate 10 0 0 0 Camera \"perspective\"",
            "a.pbrt:1:1: the axis of this Rotate has no length",
        ),
        (
            "Camera \"perspective\" \"float screenwindow\" [ 0 1e999 0 0 ]",
            "a.pbrt:1:43: the screen window is not finite",
        ),
        (
            "Film \"image\" \"float cropwindow\" [ 0 nan 0 1 ]",
            "a.pbrt:1:33: `cropwindow` takes fractions",
        ),
        (
            "Film \"image\" \"integer pixelbounds\" [ 0 1.5 0 20 ]",
            "a.pbrt:1:36: `pixelbounds` takes four integers",
        ),
        ("Include \"\"", "a.pbrt:1:9: the name of the file is empty"),
        (
            "Film \"image\" \"integer xresolution\" 0",
            "a.pbrt:1:36: `xresolution` is 0, expected an integer from 1 to",
        ),
        (
            "Film \"image\" \"integer yresolution\" 1.5",
            "a.pbrt:1:36: `yresolution` is 1.5",
        ),
        (
            "Film \"image\" \"string filename\" 7",
            "a.pbrt:1:32: `filename` is declared as `string`, but its value is a number",
        ),
        (
            "Film \"image\" \"float cropwindow\" [ 0 0 0 1 ]\nWorldBegin",
            "a.pbrt:1:1: the crop of the film has no pixel",
        ),
        (
            "Transform [ 1 0 0 0  0 1 0 0  0 0 1 1  0 0 0 1 ] Camera \"perspective\"",
            "a.pbrt:1:1: the last row of this matrix is 0 0 1 1",
        ),
        (
            "WorldBegin Shape \"trianglemesh\"",
            "a.pbrt:1:18: a triangle mesh without vertices",
        ),
        (
            "WorldBegin Shape \"trianglemesh\" \"point3 P\" [ 0 0 ]",
            "a.pbrt:1:44: `P` has 2 numbers",
        ),
        (
            "WorldBegin Shape \"plymesh\"",
            "a.pbrt:1:18: a mesh without a file name",
        ),
    ];
    for (text, expected) in cases {
        let found = complaint(text);
        assert!(found.starts_with(expected), "{found}");
    }
    assert_eq!(
        complaint(
            "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ]\n  \"integer indices\" [ 0 1 3 ]"
        ),
        "a.pbrt:3:27: index 3, number 3 of `indices`, names no vertex\n   |\n 3 |   \"integer indices\" [ 0 1 3 ]\n   \
         |                           ^\n   = expected an integer from 0 to 2\n   = the shape is left out, as in pbrt; its number stays"
    );
}

#[test]
fn options_are_read_without_the_world() {
    let files = [(
        "a.pbrt",
        "Film \"image\" \"string filename\" \"a.png\" Accelerator \"bvh\" \"string splitmethod\" \"hlbvh\" \
         \"integer maxnodeprims\" 2 WorldBegin Shape \"plymesh\" \"string filename\" \"missing.ply\" nonsense",
    )];
    let folder = folder(&files);
    let options = read_options(&folder.path().join("a.pbrt"), BudgetFactor::default()).unwrap();
    assert_eq!(options.film_filename.as_deref(), Some("a.png"));
    assert_eq!(options.accelerator.split_method.as_deref(), Some("hlbvh"));
    assert_eq!(options.accelerator.max_leaf, Some(2));
}

#[test]
fn a_missing_scene_is_a_missing_input() {
    let missing = load(
        Path::new("no/such.pbrt"),
        &LoadOptions::default(),
        Progress::SILENT,
    )
    .unwrap_err();
    assert_eq!(missing.kind(), ErrorKind::MissingInput);
}
