//! Small inputs that once went wrong: what the program has to do with each, as a table.
//!
//! `tests/cases/README.md` tells what is in the folders.

use assert_cmd::cargo::cargo_bin;
use feimos::film::{ChannelName, Image, exr_reader};
use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// What is right.
enum Right {
    /// `scene.pbrt` gives the hits and depths of `expected.pbrt`, without a warning.
    Same,
    /// So it does, with a warning that has this in it.
    SameWarned(&'static str),
    /// The command `feimos ARGUMENTS` ends with this code, after a message that has all of these in it.
    Ends(&'static str, i32, &'static [&'static str]),
}

use Right::{Ends, Same, SameWarned};

/// All folders of `tests/cases`, sorted.
const CASES: &[(&str, Right)] = &[
    (
        "a-name-commands-the-terminal",
        Ends("render s.pbrt --color always", 65, &["control character"]),
    ),
    ("attribute-end-before-object-end", SameWarned("pbrt-v4")),
    ("begin-without-end", SameWarned("AttributeBegin")),
    ("coordsys-nfc-nfd", Same),
    (
        "coplanar-disks",
        Ends("render scene.pbrt -o found.exr", 0, &["489 hit"]),
    ),
    ("cropwindow-1.0001", SameWarned("cropwindow")),
    ("cropwindow-and-pixelbounds", SameWarned("pixelbounds")),
    ("cropwindow-out-of-range", SameWarned("cropwindow")),
    (
        "disk-v-negative-innerradius",
        Ends("check scene.pbrt", 0, &[]),
    ),
    ("end-without-begin", SameWarned("AttributeEnd")),
    (
        "environment-camera",
        Ends(
            "check scene.pbrt",
            65,
            &[
                "scene.pbrt:2:8",
                "the closest are several perspective cameras",
            ],
        ),
    ),
    (
        "few-bytes-much-memory",
        Ends("check loop8.pbrt", 65, &["loop8.pbrt:", "--"]),
    ),
    ("gzip-padded-with-zeros", Same),
    (
        "import-coordinate-system",
        Ends("render scene.pbrt -o found.exr", 0, &["288 hit", "`q`"]),
    ),
    (
        "include-backslash",
        Ends("check scene.pbrt", 66, &["scene.pbrt:5:9", "sub/a.pbrt"]),
    ),
    (
        "include-in-other-case",
        Ends("check scene.pbrt", 66, &["scene.pbrt:5:9", "a.pbrt"]),
    ),
    ("indices-excess", SameWarned("indices")),
    ("instance-before-its-object", Same),
    ("interface-disk", Same),
    ("interface-ends-with-block", Same),
    ("interface-material", Same),
    ("lookat-commas", Same),
    ("loopsubdiv-normal", Ends("check scene.pbrt", 0, &[])),
    ("matrix-w", Same),
    ("matrix-w-almost-1", Same),
    ("matrix-w-negative", Same),
    ("medium-parameters-after-include", Same),
    (
        "mesh-beside-the-included-file",
        Ends("check scene.pbrt", 66, &["m.ply", "sub/m.ply"]),
    ),
    (
        "mesh-in-other-case",
        Ends("check scene.pbrt", 66, &["M.PLY", "m.ply"]),
    ),
    ("msvc-nan-in-light", Same),
    ("named-interface", Same),
    ("names-nfc-nfd", Same),
    ("negative-radius-disk", Same),
    ("none-material-v3", Same),
    (
        "obj-surfaces-in-silence",
        Ends("check c.obj", 65, &["c.obj:11:", "1/1/1/7/7"]),
    ),
    (
        "one-include-a-thousand-times",
        Ends("check scene.pbrt", 65, &["scene.pbrt:", "--"]),
    ),
    ("parameters-after-include", Same),
    ("phimax-underflow", Ends("check scene.pbrt", 0, &[])),
    ("ply-float-indices", Same),
    (
        "polygons-that-cross",
        Ends("check scene.pbrt", 65, &["many.ply.gz", "face"]),
    ),
    (
        "poses-t-column",
        Ends(
            "render scene.pbrt --cameras p.json -o found.exr",
            0,
            &["200 hit"],
        ),
    ),
    ("projective-matrix-of-a-light", Same),
    (
        "the-output-is-the-scene",
        Ends("render f.png", 2, &["f.png"]),
    ),
    ("transform-begin-attribute-end", SameWarned("AttributeEnd")),
    ("translate-split-over-files", Same),
    ("zero-matrix-of-a-light", Same),
];

fn cases() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases")
}

/// A copy of the case, since outputs are written beside the scene.
fn copy(folder: &str) -> TempDir {
    let copied = tempfile::tempdir().expect("a folder");
    copy_files(&cases().join(folder), copied.path());
    copied
}

fn copy_files(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).unwrap_or_else(|error| panic!("{}: {error}", from.display())) {
        let entry = entry.expect("an entry");
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            fs::create_dir(&target).expect("room");
            copy_files(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), &target).expect("room");
        }
    }
}

fn run(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(cargo_bin!("feimos"));
    command
        .current_dir(folder)
        .args(arguments.split_whitespace());
    command.output().expect("the program starts")
}

/// The image that `scene` gives, and what is said on standard error.
fn rendered(folder: &Path, scene: &str) -> (Image, String) {
    let output = run(
        folder,
        &format!("render {scene} --aov Z,t,A -o {scene}.exr"),
    );
    let said = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(0), "{scene}: {said}");
    let path = folder.join(format!("{scene}.exr"));
    let image = exr_reader::decode(&path, &fs::read(&path).expect("the image")).expect("an image");
    (image, said)
}

/// The bits of hits and depths.
fn bits(image: &Image) -> Vec<Vec<u32>> {
    let bits = |name| {
        image
            .measures(name)
            .expect("the channel")
            .iter()
            .map(|value| value.to_bits())
            .collect()
    };
    [ChannelName::Z, ChannelName::T, ChannelName::A]
        .map(bits)
        .to_vec()
}

fn assert_same(folder: &str, warning: Option<&str>) {
    let copied = copy(folder);
    let (expected, _) = rendered(copied.path(), "expected.pbrt");
    let (found, said) = rendered(copied.path(), "scene.pbrt");
    assert_eq!(found.data_window, expected.data_window, "{folder}");
    assert!(
        bits(&found) == bits(&expected),
        "{folder}: hits or depths differ\n{said}"
    );
    match warning {
        Some(warning) => {
            let place = said.contains("scene.pbrt:") && said.contains("warning: ");
            assert!(
                place && said.contains(warning),
                "{folder}: no warning of `{warning}` in\n{said}"
            );
        }
        None => assert!(!said.contains("warning: "), "{folder}: {said}"),
    }
    let strict = run(copied.path(), "check scene.pbrt --strict");
    assert_eq!(
        strict.status.code(),
        Some(i32::from(warning.is_some())),
        "{folder} under --strict"
    );
}

fn assert_ends(folder: &str, arguments: &str, code: i32, parts: &[&str]) {
    let copied = copy(folder);
    let output = run(copied.path(), arguments);
    let said = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(code), "{folder}: {said}");
    for part in parts {
        assert!(said.contains(part), "{folder}: no `{part}` in\n{said}");
    }
}

#[test]
fn every_case_is_right() {
    // All failures are shown at once, each by the message of its assertion.
    let wrong: Vec<&str> = CASES
        .iter()
        .filter(|case| catch_unwind(|| check(case)).is_err())
        .map(|case| case.0)
        .collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

fn check((folder, right): &(&str, Right)) {
    match right {
        Same => assert_same(folder, None),
        SameWarned(warning) => assert_same(folder, Some(warning)),
        Ends(arguments, code, parts) => assert_ends(folder, arguments, *code, parts),
    }
}

#[test]
fn every_folder_is_in_the_table() {
    let entries = fs::read_dir(cases())
        .expect("tests/cases")
        .map(|entry| entry.expect("an entry").path());
    let mut folders: Vec<PathBuf> = entries.filter(|path| path.is_dir()).collect();
    folders.sort();
    let names = folders.iter().map(|path| {
        path.file_name()
            .and_then(|name| name.to_str())
            .expect("a name")
    });
    assert_eq!(
        names.collect::<Vec<_>>(),
        CASES.iter().map(|(folder, _)| *folder).collect::<Vec<_>>()
    );
}

/// The bits of a channel of `scene.pbrt` in a case.
fn channel(folder: &str, name: ChannelName, aov: &str) -> Vec<f32> {
    let copied = copy(folder);
    let output = run(
        copied.path(),
        &format!("render scene.pbrt --aov {aov} -o found.exr"),
    );
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let path = copied.path().join("found.exr");
    let image = exr_reader::decode(&path, &fs::read(&path).expect("the image")).expect("an image");
    image.measures(name).expect("the channel").to_vec()
}

#[test]
fn a_sector_too_thin_for_its_sine_keeps_half_a_circle() {
    let z = channel("phimax-underflow", ChannelName::Z, "Z");
    let hits = [
        0x40a0_0000,
        0x409c_c471,
        0x4092_a476,
        0x4080_0000,
        0x4040_0000,
    ]
    .map(f32::from_bits);
    let mut expected = [f32::INFINITY; 17];
    expected[8..13].copy_from_slice(&hits);
    assert_eq!(z, expected);
}

#[test]
fn normals_of_a_subdivision_surface_point_where_those_of_pbrt_do() {
    let [x, y, z] = [ChannelName::Nx, ChannelName::Ny, ChannelName::Nz]
        .map(|name| channel("loopsubdiv-normal", name, "N"));
    let is_by_pbrt = |pixel: usize| {
        let by_pbrt = [0.426_79, -0.797_31, -0.426_79];
        [x[pixel], y[pixel], z[pixel]]
            .into_iter()
            .zip(by_pbrt)
            .all(|(found, expected)| (found - expected as f32).abs() < 1e-4)
    };
    assert!((0..x.len()).any(is_by_pbrt));
    // The eye is at 4 5 3: against the right hand of the control faces, all that is seen points away from it.
    let away = |pixel: usize| 4.0 * x[pixel] + 5.0 * y[pixel] + 3.0 * z[pixel] <= 0.0;
    assert!((0..x.len()).all(away));
}

#[test]
fn v_of_a_disk_takes_the_sign_of_its_inner_radius() {
    let v = channel("disk-v-negative-innerradius", ChannelName::V, "A,uv");
    let hits: Vec<f32> = v.into_iter().filter(|v| *v != 0.0).collect();
    assert!(
        !hits.is_empty() && hits.iter().all(|v| (v - 0.139_62).abs() < 1e-4),
        "{hits:?}"
    );
}
