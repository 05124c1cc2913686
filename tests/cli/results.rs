//! Results replace older results of feimos, but no files of other programs.

use crate::folder::{BALL, Folder};
use crate::overwriting::{MESH, ONCE, folder};
use std::fs;

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
fn a_page_of_another_program_is_not_overwritten() {
    let folder = Folder::new().with("index.html", "<html>my site</html>");
    folder
        .bench(&format!("ball.pbrt {ONCE} --report ."))
        .failed(73, "./index.html: exists already, and is not a report");
    assert_eq!(folder.text("index.html"), "<html>my site</html>");
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
