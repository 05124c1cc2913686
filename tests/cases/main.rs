//! Small inputs that the program once got wrong; `README.md` describes their folders.

mod table;

use assert_cmd::cargo::cargo_bin;
use feimos::film::{ChannelName, Image, exr_reader};
use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use table::CASES;
use table::Right::{self, Ends, Same, SameWarned};
use tempfile::TempDir;

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
    // The eye is at 4 5 3. All visible normals point away from it, against the right hand of the
    // control faces.
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
