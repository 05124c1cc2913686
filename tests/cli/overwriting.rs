//! Inputs are never overwritten, and files of other programs are not replaced.

use crate::folder::{BALL, Folder, Run};
use std::fs;

/// Options for one round of one configuration.
const ONCE: &str = "--runs 1 --warmup 0 --accel sah --precision fast --reference none";

const MESH: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 1\n1 0 1\n0 1 1\n3 0 1 2\n";

/// A scene that reads two other files.
const PARTS: &str =
    "WorldBegin\nInclude \"part.inc\"\nShape \"plymesh\" \"string filename\" \"mesh.ply\"\n";

fn folder() -> Folder {
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

#[test]
fn without_measurements_older_results_stay() {
    let folder = folder()
        .with("bad.pbrt", "Shap")
        .with("r.csv", "old")
        .with("r.json", "old")
        .with("r.md", "old");
    fs::create_dir(folder.path("out")).unwrap();
    let old = "<title>feimos: speed against error</title>";
    let folder = folder.with("r.svg", "old").with("out/index.html", old);
    let outputs = "--csv r.csv --json-file r.json --markdown r.md --plot r.svg --report out";
    for (scenes, code) in [
        ("gone.pbrt", 66),
        ("bad.pbrt", 65),
        ("bad.pbrt gone.ply", 66),
    ] {
        folder
            .bench(&format!("{scenes} {ONCE} {outputs}"))
            .exited(code);
        assert!(
            ["r.csv", "r.json", "r.md", "r.svg"]
                .iter()
                .all(|name| folder.text(name) == "old")
        );
        assert_eq!(folder.text("out/index.html"), old);
    }
    folder
        .bench(&format!(
            "gone.pbrt {ONCE} --report new/page --csv new/page/r.csv"
        ))
        .exited(66);
    assert!(!folder.path("new").exists());
    let run = folder
        .bench(&format!("gone.pbrt {ONCE} --csv -"))
        .exited(66);
    assert!(run.stdout.is_empty());
    // Of several scenes, rows of the others are written.
    folder
        .bench(&format!("gone.pbrt ball.pbrt bad.pbrt {ONCE} {outputs}"))
        .exited(66);
    assert_eq!(folder.text("r.csv").lines().count(), 2);
    assert!(folder.text("out/index.html").contains("ball.pbrt"));
}

#[test]
fn a_page_of_another_program_is_not_overwritten() {
    let folder = Folder::new().with("index.html", "<html>my site</html>");
    folder
        .bench(&format!("ball.pbrt {ONCE} --report ."))
        .failed(73, "./index.html: exists already, and is not a report");
    assert_eq!(folder.text("index.html"), "<html>my site</html>");
}

#[cfg(unix)]
#[test]
fn links_to_inputs_are_refused_as_outputs() {
    use std::os::unix::fs::symlink;
    let folder = folder();
    let links = [
        ("ball.pbrt", "o.png"),
        ("part.inc", "part.exr"),
        ("part.inc", "part.jsonl"),
        ("mesh.ply", "m.csv"),
    ];
    links
        .iter()
        .for_each(|(target, link)| symlink(target, folder.path(link)).unwrap());
    symlink("poses.json", folder.path("poses.npy")).unwrap();
    fs::hard_link(folder.path("mesh.ply"), folder.path("mesh.png")).unwrap();
    let of_scene = "would overwrite a file that the scene reads\n   = it is the same file as";
    let cases = [
        (
            "render ball.pbrt -o o.png",
            "o.png: -o would overwrite a scene\n   = it is the same file as ball.pbrt".to_owned(),
        ),
        (
            "render parts.pbrt -o part.exr",
            format!("part.exr: -o {of_scene} part.inc"),
        ),
        (
            "render parts.pbrt -o mesh.png",
            format!("mesh.png: -o {of_scene} mesh.ply"),
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
            format!("m.csv: --csv {of_scene} mesh.ply"),
        ),
    ];
    for (command, message) in cases {
        refused(&folder, command, &message);
    }
    let run = folder.render("ball.pbrt parts.pbrt -o {stem}.exr --manifest part.jsonl");
    run.failed(
        73,
        "part.jsonl: exists already, and is not a manifest by feimos",
    );
    assert_eq!(folder.text("part.inc"), "Shape \"sphere\"\n");
    // Another line would still be one of a scene that cannot be read.
    let part = "{\"scene\":";
    let folder = folder.with("part.inc", part);
    folder
        .render("parts.pbrt -o a.exr --manifest part.jsonl")
        .failed(2, &format!("part.jsonl: --manifest {of_scene} part.inc"));
    assert_eq!(folder.text("part.inc"), part);
}

#[cfg(unix)]
#[test]
fn measurements_before_a_conflict_are_written() {
    let folder = folder();
    std::os::unix::fs::symlink("mesh.ply", folder.path("m.csv")).unwrap();
    let run = folder.bench(&format!(
        "ball.pbrt parts.pbrt {ONCE} --csv m.csv --json-file r.json"
    ));
    run.failed(
        2,
        "m.csv: --csv would overwrite a file that the scene reads",
    );
    assert_eq!(folder.text("mesh.ply"), MESH);
    let document: serde_json::Value = serde_json::from_slice(&folder.bytes("r.json")).unwrap();
    assert_eq!(document["rows"].as_array().unwrap().len(), 1);
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

#[test]
fn a_name_from_the_scene_replaces_only_images_by_feimos() {
    let folder = Folder::new().with("film.exr", "my holidays");
    let advice = "use -o to name another one, move it away, or use --force to overwrite it";
    folder
        .render("ball.pbrt")
        .failed(
            73,
            "film.exr: exists already, and is not an image by feimos",
        )
        .said(advice);
    assert_eq!(folder.text("film.exr"), "my holidays");
    folder.render("ball.pbrt --force").succeeded();
    folder.render("ball.pbrt --accel none").succeeded();
    folder.render("ball.pbrt --miss 0").succeeded();
    assert_eq!(folder.exr("film.exr").size, (13, 7));
    for name in ["f.png", "f.pfm", "f.npy", "../f.png"] {
        let scene = format!("{}.pbrt", name.replace(['.', '/'], ""));
        let folder = Folder::new();
        fs::create_dir(folder.path("sub")).unwrap();
        let folder = folder.with(&format!("sub/{scene}"), BALL.replace("film.exr", name));
        folder
            .render(&format!(
                "sub/{scene} -o {}",
                name.trim_start_matches("../")
            ))
            .succeeded();
    }
    // These formats do not tell who wrote them.
    let folder = Folder::new().with("f.pbrt", BALL.replace("film.exr", "f.pfm"));
    folder.render("f.pbrt").succeeded();
    folder
        .render("f.pbrt")
        .failed(73, "f.pfm: exists already, and is not an image by feimos");
    folder.render("f.pbrt -o f.pfm").succeeded();
}

#[test]
fn a_bare_mesh_does_not_replace_its_photograph() {
    let folder = folder().with("mesh.png", "a photograph");
    folder.render("mesh.ply --resolution 2x2").failed(
        73,
        "mesh.png: exists already, and is not an image by feimos",
    );
    assert_eq!(folder.text("mesh.png"), "a photograph");
}
