//! Errors say what is wrong, where, and what to do: in the words of the program.

use crate::{load, scene_path};
use feimos::{Channel, ErrorKind, LoadOptions, Scene};
use std::fs;
use std::process::Command;

#[test]
fn a_wrong_scene_is_reported_as_by_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("wrong.pbrt");
    fs::write(&path, "WorldBegin\nShape \"sphere\" \"float radius\" [1\n").expect("room for it");
    let error = Scene::load(&path).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadInput);
    assert_eq!(error.kind().exit_code(), 65);
    let text = error.to_string();
    assert!(text.contains("wrong.pbrt:2:"), "{text}");
    let output = Command::new(env!("CARGO_BIN_EXE_feimos"))
        .args(["render", "-o", "-"])
        .arg(&path)
        .output()
        .expect("the program runs");
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(
        messages.contains(&text),
        "{messages}\ndoes not contain\n{text}"
    );
}

#[test]
fn a_missing_file_is_named() {
    let error = Scene::load("no/such.pbrt").unwrap_err();
    assert_eq!(error.kind(), ErrorKind::MissingInput);
    assert!(
        error.to_string().starts_with("no/such.pbrt: cannot read"),
        "{error}"
    );
}

#[test]
fn triangles_are_checked() {
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let error = Scene::from_triangles(&points, &[[0, 1, 2], [2, 3, 0], [9, 9, 9]]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Usage);
    assert_eq!(
        error.to_string(),
        "triangle 1 has index 3 of 3 points\n   = expected indices that count points from 0"
    );
    let error = Scene::from_triangles(&[], &[[0; 3]]).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("triangle 0 has index 0 of 0 points"),
        "{error}"
    );
    let empty = Scene::from_triangles(&points, &[]).expect("an empty mesh");
    assert_eq!((empty.primitive_count(), empty.bounds()), (0, None));
    assert_eq!(
        empty.warnings(),
        ["the mesh has no faces, only 3 vertices\n   = rays cannot hit it"]
    );
    let image = empty
        .render(&empty.camera(), &[Channel::A])
        .expect("an image");
    assert!(
        image
            .values(Channel::A)
            .expect("requested")
            .iter()
            .all(|a| *a == 0.0)
    );
}

#[test]
fn options_are_checked() {
    let cases = [
        (
            LoadOptions::new().resolution([0, 5]),
            "resolution 0\n   = expected two numbers from 1 to",
        ),
        (
            LoadOptions::new().time(1.5),
            "time 1.5\n   = expected a number from 0 to 1",
        ),
        (LoadOptions::new().time(f64::NAN), "time NaN"),
        (
            LoadOptions::new().alpha_cutoff(1.0),
            "alpha cutoff 1\n   = expected a number from 0 to",
        ),
        (
            LoadOptions::new().input_budget(0),
            "input budget 0\n   = expected a number from 1 to",
        ),
    ];
    for (options, expected) in cases {
        let error = Scene::load_with(scene_path("sphere.pbrt"), &options).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Usage);
        assert!(error.to_string().starts_with(expected), "{error}");
    }
}

#[test]
fn images_are_checked() {
    let scene = load("sphere.pbrt", [8, 6]);
    let camera = scene.camera();
    let error = scene.render(&camera, &[]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "an image without channels\n   = expected at least one, such as Z"
    );
    let image = scene.render(&camera, &[Channel::Prim]).expect("an image");
    let folder = tempfile::tempdir().expect("a folder");
    for (name, expected) in [
        (
            "a.png",
            "a .png shows depths, and the image has no channel Z",
        ),
        (
            "a.pfm",
            "a .pfm holds one channel of f32, and the image has no channel Z",
        ),
        ("a.jpg", "unknown image format `.jpg`"),
    ] {
        let error = image.save(folder.path().join(name)).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
        assert_eq!(error.kind(), ErrorKind::Usage);
    }
    let error = image
        .save(folder.path().join("no/such/folder/a.exr"))
        .unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Output);
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}

#[test]
fn unknown_names_list_the_known_ones() {
    let error = "depth".parse::<Channel>().unwrap_err();
    assert_eq!(
        error.to_string(),
        "unknown `depth`: expected one of Z, t, A, id, prim, instance, N, P, uv, cost"
    );
    let error = "bvh".parse::<feimos::SplitMethod>().unwrap_err();
    assert_eq!(
        error.to_string(),
        "unknown `bvh`: expected one of none, middle, equal, sah, hlbvh"
    );
}
