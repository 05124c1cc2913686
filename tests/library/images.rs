//! Images of the library are those of the program.

use crate::{CHANNELS, SCENES, assert_same, load};
use feimos::{Channel, LoadOptions, Precision, Scene, SplitMethod};
use std::fs;
use std::path::Path;
use std::process::Command;

const SIZE: [u32; 2] = [61, 47];

/// The bytes of an image that the program renders to `file`, in `folder`.
fn by_program(scene: &Path, folder: &Path, file: &str, flags: &[&str]) -> Vec<u8> {
    let names: Vec<&str> = CHANNELS.iter().map(|channel| channel.name()).collect();
    let path = folder.join(file);
    let output = Command::new(env!("CARGO_BIN_EXE_feimos"))
        .args(["render", "--force", "--aov", &names.join(",")])
        .arg(scene)
        .arg("-o")
        .arg(&path)
        .args(flags)
        .output()
        .expect("the program runs");
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{messages}");
    fs::read(&path).expect("the program has written it")
}

#[test]
fn every_channel_is_that_of_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let size = format!("{}x{}", SIZE[0], SIZE[1]);
    for name in SCENES {
        let path = crate::scene_path(name);
        let flags = ["--resolution", &size];
        let expected = by_program(&path, folder.path(), "program.npy", &flags);
        let scene = load(name, SIZE);
        let bins = scene.render(&scene.camera(), &CHANNELS).expect("an image");
        let own = folder.path().join("library.npy");
        bins.save(&own).expect("room for it");
        assert!(fs::read(&own).expect("written") == expected, "{name}");
        for method in SplitMethod::ALL {
            let structure = scene.build(method).expect("a structure");
            let tree = structure
                .render(&scene.camera(), &CHANNELS)
                .expect("an image");
            assert_same(&bins, &tree, &format!("{name}, {method}"));
        }
    }
}

#[test]
fn fast_images_are_those_of_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let flags = ["--precision", "fast", "--resolution", "61x47"];
    let path = crate::scene_path("quadrics.pbrt");
    let expected = by_program(&path, folder.path(), "program.npy", &flags);
    let scene = load("quadrics.pbrt", SIZE);
    let fast = scene.with_precision(Precision::Fast);
    let image = fast.render(&scene.camera(), &CHANNELS).expect("an image");
    let own = folder.path().join("library.npy");
    image.save(&own).expect("room for it");
    assert!(fs::read(&own).expect("written") == expected);
    let exact = scene.render(&scene.camera(), &CHANNELS).expect("an image");
    assert!(
        image.values(Channel::Z) != exact.values(Channel::Z),
        "roundings show"
    );
}

/// A tetrahedron with texture coordinates and vertex normals, as a mesh file.
const MESH: &str = "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\n\
    vt 0.25 0.5\nvt 0.75 0\nvt 1 1\nvn 0 0 -1\nvn 1 1 1\n\
    f 1/1/1 3/2/1 2/3/1\nf 1/1/2 2/2/2 4/3/2\nf 1/1/1 4/2/1 3/3/2\nf 2/1/2 3/2/2 4/3/2\n";

#[test]
fn meshes_are_framed_as_by_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mesh.obj");
    fs::write(&path, MESH).expect("room for it");
    let expected = by_program(
        &path,
        folder.path(),
        "program.npy",
        &["--resolution", "64x36"],
    );
    let options = LoadOptions::new().resolution([64, 36]);
    let scene = Scene::load_with(&path, &options).expect("a mesh");
    let image = scene.render(&scene.camera(), &CHANNELS).expect("an image");
    let own = folder.path().join("library.npy");
    image.save(&own).expect("room for it");
    assert!(fs::read(&own).expect("written") == expected);
}

#[test]
fn a_crop_of_the_file_is_the_image() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("crop.pbrt");
    let text = "Film \"image\" \"integer xresolution\" 40 \"integer yresolution\" 30\n\
        \"integer pixelbounds\" [7 29 5 21]\nLookAt 0 0 -4 0 0 0 0 1 0\nCamera \"perspective\"\n\
        WorldBegin\nShape \"sphere\"\n";
    fs::write(&path, text).expect("room for it");
    let scene = Scene::load(&path).expect("a scene");
    let camera = scene.camera();
    assert_eq!(camera.size(), [22, 16]);
    let image = scene.render(&camera, &CHANNELS).expect("an image");
    assert_eq!(image.size(), [22, 16]);
    let expected = by_program(&path, folder.path(), "program.npy", &[]);
    let own = folder.path().join("library.npy");
    image.save(&own).expect("room for it");
    assert!(fs::read(&own).expect("written") == expected);
}

#[test]
fn costs_are_those_of_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = crate::scene_path("triangles.pbrt");
    let flags = ["--resolution", "61x47", "--aov", "cost"];
    let output = folder.path().join("program.npy");
    let status = Command::new(env!("CARGO_BIN_EXE_feimos"))
        .arg("render")
        .arg(&path)
        .args(flags)
        .arg("-o")
        .arg(&output)
        .status();
    assert!(status.expect("the program runs").success());
    let scene = load("triangles.pbrt", SIZE);
    let image = scene
        .render(&scene.camera(), &[Channel::Cost])
        .expect("an image");
    assert!(
        image
            .numbers(Channel::Cost)
            .expect("requested")
            .iter()
            .any(|cost| *cost > 1)
    );
    let own = folder.path().join("library.npy");
    image.save(&own).expect("room for it");
    assert_eq!(
        fs::read(&own).expect("written"),
        fs::read(&output).expect("written")
    );
}

#[test]
fn channels_have_names_and_components() {
    let scene = load("sphere.pbrt", [9, 7]);
    let camera = scene.camera();
    let image = scene.render(&camera, &Channel::ALL).expect("an image");
    assert!(image.channels().eq(Channel::ALL));
    for channel in Channel::ALL {
        assert_eq!(channel.name().parse::<Channel>(), Ok(channel));
        let values = image.values(channel).map(<[f32]>::len);
        let numbers = image.numbers(channel).map(<[u32]>::len);
        assert_eq!(values.is_none(), channel.is_integer(), "{channel}");
        assert_eq!(
            values.or(numbers),
            Some(63 * channel.components()),
            "{channel}"
        );
    }
    let twice = scene.render(&camera, &[Channel::Z, Channel::A, Channel::Z]);
    let twice = twice.expect("an image");
    assert!(twice.channels().eq([Channel::Z, Channel::A]));
    assert_eq!(twice.numbers(Channel::Prim), None);
    let length = image.into_channels().len();
    assert_eq!(length, Channel::ALL.len());
}

#[test]
fn every_format_can_be_saved_and_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = load("sphere.pbrt", [40, 30]);
    let channels = [Channel::Z, Channel::Prim, Channel::Normal];
    let image = scene.render(&scene.camera(), &channels).expect("an image");
    for name in ["a.exr", "a.npy", "a.pfm", "a.png"] {
        image.save(folder.path().join(name)).expect("room for it");
    }
    let compare = |names: [&str; 2]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_feimos"));
        command.arg("compare").current_dir(folder.path());
        let output = command.args(names).arg("--json").output();
        let output = output.expect("the program runs");
        let line = String::from_utf8(output.stdout).expect("JSON");
        (output.status.code(), line)
    };
    let (code, line) = compare(["a.exr", "a.npy"]);
    assert_eq!(code, Some(0), "{line}");
    let (code, line) = compare(["a.exr", "a.pfm"]);
    assert_eq!(code, Some(0), "{line}");
    let png = fs::read(folder.path().join("a.png")).expect("written");
    assert!(png.starts_with(b"\x89PNG") && png.len() > 200);
}
