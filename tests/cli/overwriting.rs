//! Outputs never overwrite inputs.

use crate::folder::{BALL, Folder, Run};
use std::fs;

/// Options for one round of one configuration.
pub(crate) const ONCE: &str = "--runs 1 --warmup 0 --accel sah --precision fast --reference none";

pub(crate) const MESH: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 1\n1 0 1\n0 1 1\n3 0 1 2\n";

/// A scene that reads two other files.
const PARTS: &str =
    "WorldBegin\nInclude \"part.inc\"\nShape \"plymesh\" \"string filename\" \"mesh.ply\"\n";

pub(crate) fn folder() -> Folder {
    let folder = Folder::new()
        .with("parts.pbrt", PARTS)
        .with("part.inc", "Shape \"sphere\"\n");
    folder.with("mesh.ply", MESH).with(
        "poses.json",
        r#"[{"name": "a", "lookat": [0, 0, -5, 0, 0, 0, 0, 1, 0]}]"#,
    )
}

/// The content of all files in the folder, by name.
fn content(folder: &Folder) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder.path("."))
        .unwrap()
        .map(|entry| entry.unwrap());
    let files = entries.filter(|entry| entry.file_type().unwrap().is_file());
    let mut content: Vec<_> = files
        .map(|file| {
            (
                file.file_name().into_string().unwrap(),
                fs::read(file.path()).unwrap(),
            )
        })
        .collect();
    content.sort();
    content
}

/// Runs `command`, which must fail without writing anything.
#[track_caller]
fn refused(folder: &Folder, command: &str, message: &str) -> Run {
    let before = content(folder);
    let (name, arguments) = command.split_once(' ').unwrap();
    let run = folder.run(name, arguments).failed(2, message);
    assert!(content(folder) == before, "{command}");
    assert!(run.stdout.is_empty(), "{command}");
    run
}

#[test]
fn results_do_not_overwrite_a_scene() {
    let folder = folder();
    for flag in ["--json-file", "--csv", "--markdown", "--plot"] {
        let message = format!(
            "./ball.pbrt: {flag} would overwrite a scene\n   = it is the same file as ball.pbrt"
        );
        refused(
            &folder,
            &format!("bench mesh.ply ball.pbrt {ONCE} {flag} ./ball.pbrt"),
            &message,
        );
        refused(
            &folder,
            &format!("bench mesh.ply {flag} mesh.ply"),
            &format!("mesh.ply: {flag} would overwrite a scene"),
        );
    }
    refused(
        &folder,
        "render ball.pbrt --manifest ball.pbrt",
        "ball.pbrt: --manifest would overwrite a scene",
    );
    let message = "poses.json: --manifest would overwrite the list of cameras";
    refused(
        &folder,
        "render ball.pbrt -o {camera}.exr --cameras poses.json --manifest poses.json",
        message,
    );
    refused(
        &folder,
        "render gone.pbrt ball.pbrt -o ball.pbrt",
        "unknown image format `.pbrt`",
    );
}

#[test]
fn results_need_their_extensions() {
    let folder = folder();
    let cases = [
        (
            "bench ball.pbrt --json-file a.txt",
            "a.txt: --json-file writes another kind of file\n   = expected a name that ends in .json or .jsonl",
        ),
        (
            "bench ball.pbrt --csv a",
            "a: --csv writes another kind of file\n   = expected a name that ends in .csv",
        ),
        (
            "bench ball.pbrt --csv part.inc",
            "expected a name that ends in .csv",
        ),
        (
            "bench ball.pbrt --markdown a.html",
            "expected a name that ends in .md",
        ),
        (
            "bench ball.pbrt --plot a.png",
            "expected a name that ends in .svg",
        ),
        (
            "render ball.pbrt --manifest part.inc",
            "part.inc: --manifest writes another kind of file\n   = expected a name that ends in .jsonl or .json",
        ),
    ];
    for (command, message) in cases {
        refused(&folder, command, message);
    }
    folder
        .bench(&format!("ball.pbrt {ONCE} --csv A.CSV"))
        .succeeded();
}

#[test]
fn json_with_a_file_name_is_refused_with_advice() {
    let folder = folder();
    let message = "results.json: this is a result file, not a scene\n   = --json takes no file name: it \
                   prints to standard output\n   = did you mean --json-file results.json?";
    refused(&folder, "bench --json results.json ball.pbrt", message);
    refused(
        &folder,
        "bench --json - ball.pbrt",
        "did you mean --json-file -?",
    );
    refused(
        &folder,
        "render --json a.jsonl ball.pbrt -o a.exr",
        "did you mean --json > a.jsonl?",
    );
    refused(
        &folder,
        "check --json a.json ball.pbrt",
        "a.json: this is a result file",
    );
    // Two scenes are two scenes.
    let run = folder
        .bench(&format!("--json ball.pbrt parts.pbrt {ONCE}"))
        .succeeded();
    let document: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(document["rows"].as_array().unwrap().len(), 2);
}

/// A folder in which some names of outputs are links to inputs.
#[cfg(unix)]
fn linked() -> Folder {
    let folder = folder();
    for (target, link) in [
        ("ball.pbrt", "o.png"),
        ("part.inc", "part.exr"),
        ("part.inc", "part.jsonl"),
        ("mesh.ply", "m.csv"),
        ("poses.json", "poses.npy"),
    ] {
        std::os::unix::fs::symlink(target, folder.path(link)).unwrap();
    }
    fs::hard_link(folder.path("mesh.ply"), folder.path("mesh.png")).unwrap();
    folder
}

#[cfg(unix)]
const OF_SCENE: &str = "would overwrite a file that the scene reads\n   = it is the same file as";

#[cfg(unix)]
#[test]
fn links_to_inputs_are_refused_as_outputs() {
    let folder = linked();
    let cases = [
        (
            "render ball.pbrt -o o.png",
            "o.png: -o would overwrite a scene\n   = it is the same file as ball.pbrt".to_owned(),
        ),
        (
            "render parts.pbrt -o part.exr",
            format!("part.exr: -o {OF_SCENE} part.inc"),
        ),
        (
            "render parts.pbrt -o mesh.png",
            format!("mesh.png: -o {OF_SCENE} mesh.ply"),
        ),
        (
            "render mesh.ply --resolution 2x2",
            "mesh.png: the image name in the scene would overwrite a scene".to_owned(),
        ),
        (
            "render mesh.ply --resolution 2x2 --force",
            "would overwrite a scene".to_owned(),
        ),
        (
            "render ball.pbrt --cameras poses.json -o poses.npy",
            "poses.npy: -o would overwrite the list of cameras".to_owned(),
        ),
        (
            "bench mesh.ply --csv m.csv",
            "m.csv: --csv would overwrite a scene".to_owned(),
        ),
        (
            &format!("bench parts.pbrt {ONCE} --csv m.csv"),
            format!("m.csv: --csv {OF_SCENE} mesh.ply"),
        ),
    ];
    for (command, message) in cases {
        refused(&folder, command, &message);
    }
}

#[cfg(unix)]
#[test]
fn a_manifest_linked_to_an_input_does_not_overwrite_it() {
    let folder = linked();
    let run = folder.render("ball.pbrt parts.pbrt -o {stem}.exr --manifest part.jsonl");
    run.failed(
        73,
        "part.jsonl: exists already, and is not a manifest by feimos",
    );
    assert_eq!(folder.text("part.inc"), "Shape \"sphere\"\n");
    // This input looks like the start of a manifest.
    let part = "{\"scene\":";
    let folder = folder.with("part.inc", part);
    folder
        .render("parts.pbrt -o a.exr --manifest part.jsonl")
        .failed(2, &format!("part.jsonl: --manifest {OF_SCENE} part.inc"));
    assert_eq!(folder.text("part.inc"), part);
}

#[test]
fn compared_and_merged_images_are_not_overwritten() {
    let folder = folder();
    folder.render("ball.pbrt -o a.exr").succeeded();
    folder.render("ball.pbrt -o a.png").succeeded();
    refused(
        &folder,
        "compare a.png a.png --diff ./a.png",
        "./a.png: --diff would overwrite a compared image",
    );
    refused(
        &folder,
        "merge a.exr -o ./a.exr",
        "./a.exr: -o would overwrite a crop",
    );
    #[cfg(unix)]
    {
        fs::hard_link(folder.path("a.exr"), folder.path("b.png")).unwrap();
        refused(
            &folder,
            "compare a.exr a.exr --diff b.png",
            "b.png: --diff would overwrite a compared image",
        );
        std::os::unix::fs::symlink("a.exr", folder.path("c.exr")).unwrap();
        refused(
            &folder,
            "merge a.exr -o c.exr",
            "c.exr: -o would overwrite a crop",
        );
    }
}

#[test]
fn a_scene_does_not_overwrite_itself() {
    let scene = BALL.replace("film.exr", "self.png");
    let folder = Folder::new().with("self.png", &scene);
    refused(
        &folder,
        "render self.png",
        "self.png: the image name in the scene would overwrite a scene",
    );
    refused(
        &folder,
        "render self.png --force",
        "would overwrite a scene",
    );
}
