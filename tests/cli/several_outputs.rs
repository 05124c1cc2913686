//! Several files of one trace.

use crate::exr_file::Exr;
use crate::folder::{BALL, Folder};
use std::fs;

#[test]
fn each_file_is_the_one_that_a_command_of_its_own_writes() {
    let folder = Folder::new();
    let run = folder
        .render("ball.pbrt -o a.exr -o a.npy -o a.pfm -o a.png -o b.png --view depth,id16")
        .succeeded();
    run.said("a.exr, a.npy, a.pfm, a.png, b.png: 13 x 7 pixels, 13 hit (load ")
        .said("\na.png: depth 4 (red) to ")
        .said("\nb.png: the number of each shape, misses 0\n");
    for (name, flags) in [
        ("a.exr", ""),
        ("a.npy", ""),
        ("a.pfm", ""),
        ("a.png", ""),
        ("b.png", "--view id16"),
    ] {
        let alone = format!("alone-{name}");
        folder
            .render(&format!("ball.pbrt -o {alone} {flags}"))
            .succeeded();
        assert!(folder.bytes(name) == folder.bytes(&alone), "{name}");
    }
}

#[test]
fn costs_and_hits_of_one_trace_are_those_of_their_own() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.exr -o cost.png -o mask.png --view cost,mask --aov t,A --miss 7")
        .succeeded();
    folder
        .render("ball.pbrt -o b.exr --aov t,A --miss 7")
        .succeeded();
    folder
        .render("ball.pbrt -o alone.png --view cost")
        .succeeded();
    assert!(folder.bytes("a.exr") == folder.bytes("b.exr"));
    assert!(folder.bytes("cost.png") == folder.bytes("alone.png"));
    folder
        .render("ball.pbrt -o a.exr -o cost.png --view cost --accel raster")
        .failed(2, "raster has none");
}

#[test]
fn one_view_is_for_all_png_files_and_several_are_one_for_each() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.png -o b.exr -o c.png --view normal")
        .succeeded();
    assert!(folder.bytes("a.png") == folder.bytes("c.png"));
    folder
        .render("ball.pbrt -o hit.png -o b.exr -o normal.png --view hit --view normal")
        .succeeded();
    assert!(folder.bytes("normal.png") == folder.bytes("a.png"));
    assert!(folder.bytes("hit.png") != folder.bytes("a.png"));
    folder
        .render("ball.pbrt -o a.png -o b.exr --view hit,normal")
        .failed(2, "--view hit,normal names 2 views for 1 PNG output\n")
        .said("give one -o NAME.png for each view");
    folder
        .render("ball.pbrt -o a.exr --view hit,normal")
        .failed(2, "--view has no meaning for a.exr");
}

#[test]
fn an_option_needs_a_meaning_for_one_of_the_files() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.png -o b.exr --aov Z,id --colormap gray --range 3,9")
        .succeeded();
    assert_eq!(folder.exr("b.exr").channels(), ["Z", "id"]);
    folder
        .render("ball.pbrt -o a.npy -o b.exr --colormap gray")
        .failed(2, "--colormap has no meaning for a.npy");
    folder
        .render("ball.pbrt -o a.pfm -o b.exr --aov Z,id")
        .failed(2, "a.pfm: a PFM holds one of Z");
    folder
        .render("ball.pbrt -o b.exr -o a.npy --skip-existing")
        .failed(2, "--skip-existing has no meaning for a.npy");
}

#[test]
fn an_image_that_does_not_fit_one_format_is_written_in_none() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.exr -o b.png --view depth16 --scale 1e5")
        .failed(2, "does not fit into 16 bits");
    assert!(folder.images().is_empty());
}

#[test]
fn one_place_is_not_taken_twice() {
    let folder = Folder::new().with("second.pbrt", BALL);
    for outputs in ["-o a.exr -o ./a.exr", "-o - -o -", "-o a.exr -o {stem}.exr"] {
        let scene = if outputs.contains("stem") {
            "a"
        } else {
            "ball"
        };
        let folder = Folder::new().with("a.pbrt", BALL);
        folder
            .render(&format!("{scene}.pbrt {outputs}"))
            .failed(2, "two outputs would both be written to ")
            .said("give each -o another name");
    }
    folder
        .render("ball.pbrt second.pbrt -o a.exr -o {stem}.npy")
        .failed(
            2,
            "ball.pbrt and second.pbrt would both be written to a.exr",
        );
    assert!(folder.images().is_empty());
}

#[test]
fn skipping_renders_the_files_that_are_missing() {
    let folder = Folder::new();
    let command = "ball.pbrt -o a.exr -o b.png --skip-existing -v --json";
    let outputs = |run: &crate::folder::Run| run.json()[0]["outputs"].clone();
    let run = folder.render(command).succeeded();
    assert_eq!(outputs(&run), serde_json::json!(["a.exr", "b.png"]));
    assert_eq!(run.json()[0]["output"], "a.exr");
    let before = folder.bytes("a.exr");
    folder
        .render(command)
        .succeeded()
        .said("ball.pbrt: skipped, a.exr, b.png exist already");
    fs::remove_file(folder.path("b.png")).unwrap();
    let run = folder.render(command).succeeded();
    assert_eq!(run.json()[0]["output"], "b.png");
    assert_eq!(outputs(&run), serde_json::Value::Null, "there is one");
    assert!(folder.bytes("a.exr") == before && folder.path("b.png").exists());
    // Another view makes the PNG stale, and nothing else.
    let run = folder.render(&format!("{command} --view hit")).succeeded();
    assert_eq!(run.json()[0]["output"], "b.png");
}

#[test]
fn a_batch_replaces_none_of_the_files() {
    let folder = Folder::new()
        .with("second.pbrt", BALL)
        .with("second.npy", "old");
    folder
        .render("ball.pbrt second.pbrt -o {stem}.exr -o {stem}.npy --manifest all.jsonl")
        .failed(73, "second.npy: exists already");
    assert_eq!(folder.text("second.npy"), "old");
    assert!(!folder.path("second.exr").exists() && folder.path("ball.npy").exists());
    let lines = crate::folder::json_lines(&folder.text("all.jsonl"));
    assert_eq!(
        lines[0]["image"]["outputs"],
        serde_json::json!(["ball.exr", "ball.npy"])
    );
    folder
        .render("ball.pbrt -o ball.exr -o ball.npy")
        .succeeded();
}

#[test]
fn inputs_are_safe_from_every_output() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.exr -o ball.pbrt --format exr")
        .failed(2, "ball.pbrt: -o would overwrite a scene");
    assert_eq!(folder.text("ball.pbrt"), BALL);
}

#[test]
fn commas_do_not_separate_outputs() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.npy,b.png")
        .failed(2, "-o a.npy,b.png: commas do not separate outputs")
        .said("= use -o a.npy -o b.png\n");
    folder.render("ball.pbrt -o a,b.exr").succeeded();
    assert_eq!(folder.images(), ["a,b.exr"]);
}

#[test]
fn the_format_may_be_named() {
    let folder = Folder::new();
    folder.render("ball.pbrt -o usual.npy").succeeded();
    let run = folder
        .render("ball.pbrt -o - --format npy --aov Z")
        .succeeded();
    assert!(run.stdout == folder.bytes("usual.npy"));
    folder.render("ball.pbrt -o depth --format npy").succeeded();
    assert!(folder.bytes("depth") == folder.bytes("usual.npy"));
    folder
        .render("ball.pbrt -o /dev/null")
        .failed(2, "/dev/null: no extension")
        .said("or choose the format of -o by --format");
    folder
        .render("ball.pbrt -o /dev/null --format exr")
        .succeeded();
    folder
        .render("ball.pbrt -o a.png --format exr")
        .failed(2, "--format exr contradicts the name a.png");
    folder
        .render("ball.pbrt -o a.png -o b --format npy")
        .succeeded();
    folder
        .render("ball.pbrt --format exr")
        .failed(2, "--format has no meaning without -o");
}

#[test]
fn a_folder_gets_an_image_of_each_scene() {
    let poses = r#"[{"name": "left", "lookat": [-1, 0, -5, 0, 0, 0, 0, 1, 0]},
                    {"name": "right", "lookat": [1, 0, -5, 0, 0, 0, 0, 1, 0]}]"#;
    let folder = Folder::new()
        .with("second.pbrt", BALL)
        .with("poses.json", poses);
    folder.render("ball.pbrt second.pbrt -o out/").succeeded();
    let exr = |name: &str| Exr::read(&fs::read(folder.path(name)).unwrap());
    assert_eq!(exr("out/ball.exr"), exr("out/second.exr"));
    folder
        .render("ball.pbrt -o out --view hit --force")
        .succeeded();
    folder
        .render("ball.pbrt -o seen/ --format npy --cameras poses.json")
        .succeeded();
    for name in ["out/ball.png", "seen/ball-left.npy", "seen/ball-right.npy"] {
        assert!(folder.path(name).is_file(), "{name}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_terminal_gets_no_image() {
    let folder = Folder::new();
    folder.render("ball.pbrt -o a.exr").succeeded();
    let program = folder.command("").get_program().to_owned();
    for (arguments, name) in [
        ("render ball.pbrt -o -", "standard output"),
        ("merge a.exr -o -", "standard output"),
        (
            "render ball.pbrt -o /dev/stdout --format exr",
            "/dev/stdout",
        ),
    ] {
        let line = format!("{} {arguments}", program.display());
        // `script` runs a command in a terminal.
        let mut command = std::process::Command::new("script");
        command.args(["-qec", &line, "/dev/null"]);
        let Ok(output) = command.current_dir(folder.path(".")).output() else {
            return;
        };
        let text = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(text.contains(&format!("{name} is a terminal")), "{text}");
        assert!(text.contains("> image.exr"), "{text}");
    }
}
