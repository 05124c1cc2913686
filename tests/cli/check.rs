//! `feimos check`: the content of scenes as text, folders of scenes, and warnings.

use crate::folder::{BALL, Folder, Run, WARNED};
use std::fs;

/// The scenes that the text describes.
fn titles(run: &Run) -> Vec<&str> {
    run.text()
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with(' '))
        .collect()
}

/// A folder with scenes, parts of scenes and other files below it.
fn tree() -> Folder {
    let folder = Folder::new();
    fs::create_dir_all(folder.path("b/c.pbrt")).unwrap();
    folder
        .with("b/part.pbrt", "# WorldBegin\nShape \"sphere\"\n")
        .with("b/whole.pbrt", "WorldBegin Include \"part.pbrt\"")
        .with("b/c.pbrt/deep.PBRT", "WorldBegin")
        .with("b/mesh.ply", "nothing")
        .with("b/scene.txt", "WorldBegin")
}

#[test]
fn text_lists_the_content_of_a_scene() {
    let run = Folder::new().check("ball.pbrt").succeeded();
    let expected = "\
ball.pbrt
  camera      perspective, 40 degrees, at (0, 0, -5), towards (0, 0, 1)
  film        13 x 7 pixels, film.exr
  shapes                    statements  primitives
              sphere                 1           1
              trianglemesh           1           1
  geometry    1 triangle, 1 quadric
  bounds      (-1.5, -1, -1) to (2.5, 2, 2.5)
  view        2 of 2 shapes may be in view
  memory      2 transforms, 348 bytes
  directives  1 Camera, 1 Film, 1 LookAt, 2 Shape, 1 Translate, 1 WorldBegin
";
    assert_eq!((run.text(), run.stderr.as_str()), (expected, ""));
}

#[test]
fn skipped_and_unsupported_parts_are_listed() {
    let scene = "Camera \"orthographic\" Film \"rgb\" \"integer xresolution\" 8 \
                 \"integer yresolution\" 4 \"integer pixelbounds\" [ 2 8 0 3 ]
        TransformTimes 0 1 Sampler \"x\" RenderPass \"beauty\" WorldBegin Material \"m\" \
        Material \"n\" Attribute \"light\"
        ObjectBegin \"o\" Shape \"sphere\" Shape \"sphere\" ObjectEnd
        ObjectInstance \"o\" Translate 10 0 0 ObjectInstance \"o\" Shape \"heightfield2\"";
    let run = Folder::new()
        .with("a.pbrt", scene)
        .check("a.pbrt")
        .succeeded();
    let found = run.text();
    let lines = [
        "  camera      orthographic, at (0, 0, 0), towards (0, 0, 1)\n",
        "  film        8 x 4 pixels, cropped to x 2 to 8, y 0 to 3\n",
        "              heightfield2           1    left out\n\
         \x20             sphere                 2           2\n",
        "2 instances of 1 object: 4 primitives in all\n",
        "  bounds      (-1, -1, -1) to (11, 1, 1)\n",
        "  skipped     1 Attribute, 2 Material, 1 Sampler, 1 TransformTimes\n\
         \x20 unknown     1 RenderPass\n",
    ];
    lines
        .iter()
        .for_each(|line| assert!(found.contains(line), "no `{line}` in:\n{found}"));
    run.said("warning: a.pbrt:2:40: `RenderPass` is not a directive")
        .said("the shape `heightfield2` is not supported");
}

#[test]
fn long_lists_continue_on_the_next_line() {
    let names: String = ('A'..='Z')
        .map(|letter| format!("Private{letter}{letter}{letter} "))
        .collect();
    let run = Folder::new()
        .with("a.pbrt", format!("WorldBegin {names}"))
        .check("a.pbrt -q")
        .succeeded();
    assert_eq!((run.text(), run.stderr.as_str()), ("", ""), "quiet");
    let run = Folder::new()
        .with("a.pbrt", format!("WorldBegin {names}"))
        .check("a.pbrt")
        .succeeded();
    let found = run.text();
    assert!(found.lines().all(|line| line.len() <= 100), "{found}");
    assert!(
        found.contains("\n  unknown     1 PrivateAAA, ")
            && found.contains(",\n              1 Private"),
        "{found}"
    );
}

#[test]
fn names_from_files_have_no_control_characters() {
    let scene = "WorldBegin Shape \"b\u{1b}[31m\"";
    let run = Folder::new()
        .with("a.pbrt", scene)
        .check("a.pbrt")
        .succeeded();
    assert!(
        !run.text().contains('\u{1b}') && !run.stderr.contains('\u{1b}'),
        "{run:?}"
    );
}

#[test]
fn a_bare_mesh_is_checked_if_it_is_named() {
    let folder = Folder::new().with("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let run = folder.check("m.obj").succeeded();
    assert!(
        run.text()
            .contains("              objmesh           1           1\n"),
        "{}",
        run.text()
    );
    assert_eq!(titles(&folder.check(".").succeeded()), ["./ball.pbrt"]);
}

#[test]
fn directories_are_searched_for_top_level_scenes() {
    let run = tree().check(".").succeeded();
    assert_eq!(
        titles(&run),
        ["./b/c.pbrt/deep.PBRT", "./b/whole.pbrt", "./ball.pbrt"]
    );
    let run = tree().check("b ball.pbrt").succeeded();
    assert_eq!(
        titles(&run),
        ["b/c.pbrt/deep.PBRT", "b/whole.pbrt", "ball.pbrt"]
    );
    let folder = Folder::new();
    fs::create_dir(folder.path("empty")).unwrap();
    folder
        .check("empty")
        .failed(66, "error: empty: no scene in this directory");
}

#[cfg(unix)]
#[test]
fn links_between_directories_are_not_followed() {
    let folder = tree();
    std::os::unix::fs::symlink("..", folder.path("b/up")).unwrap();
    std::os::unix::fs::symlink("b/whole.pbrt", folder.path("linked.pbrt")).unwrap();
    let run = folder.check(".").exited(66);
    assert_eq!(
        titles(&run),
        ["./b/c.pbrt/deep.PBRT", "./b/whole.pbrt", "./ball.pbrt"]
    );
    run.said("linked.pbrt").said("part.pbrt: cannot read");
}

#[test]
fn all_scenes_are_checked_and_the_highest_code_is_returned() {
    let folder = Folder::new()
        .with("bad.pbrt", "Shap")
        .with("warned.pbrt", WARNED);
    let run = folder
        .check("bad.pbrt warned.pbrt gone.pbrt ball.pbrt")
        .exited(66);
    assert_eq!(titles(&run), ["warned.pbrt", "ball.pbrt"]);
    run.said("error: bad.pbrt:1:1: unknown directive")
        .said("error: gone.pbrt: cannot read")
        .said("2 of 4 scenes failed:\n  bad.pbrt (exit code 65)\n  gone.pbrt (exit code 66)\n");
    folder.check("bad.pbrt ball.pbrt").exited(65);
    let run = folder
        .check("bad.pbrt gone.pbrt ball.pbrt --fail-fast")
        .exited(65)
        .did_not_say("gone.pbrt");
    assert!(run.stdout.is_empty());
    run.said("1 of 3 scenes failed, and 2 were not tried:");
}

#[test]
fn check_reports_the_warnings_of_render() {
    let folder = Folder::new()
        .with("warned.pbrt", WARNED)
        .with("kd.pbrt", format!("Accelerator \"kdtree\"\n{BALL}"));
    let checked = folder.check("warned.pbrt").succeeded();
    let rendered = folder.render("warned.pbrt --resolution 2x2").succeeded();
    assert!(
        checked.stderr.starts_with("warning: warned.pbrt:2:7: ")
            && rendered.stderr.starts_with(&checked.stderr)
    );
    folder
        .check("kd.pbrt")
        .succeeded()
        .said("note: the scene asks for the unknown accelerator `kdtree`");
    folder
        .check("ball.pbrt -v")
        .succeeded()
        .said("ball.pbrt: read in ");
    folder
        .check("gone.pbrt --color always")
        .exited(66)
        .said("\x1b[31merror\x1b[0m: gone.pbrt");
    folder
        .check("")
        .failed(2, "required arguments were not provided");
}

/// Each scene causes another kind of warning.
#[test]
fn every_kind_of_warning_counts_under_strict() {
    let mesh = "Shape \"trianglemesh\" \"point P\" [ 0 0 0 1 0 0 0 1 0 ]";
    let scenes = [
        "Camera \"perspective\" \"float lensradius\" 1 WorldBegin",
        "Camera \"perspective\" \"float fovv\" 1 WorldBegin",
        "Camera \"perspective\" \"float screenwindow\" [ 1 1 0 2 ] WorldBegin",
        "ActiveTransform EndTime Scale 2 2 2 ActiveTransform All Camera \"perspective\" WorldBegin",
        "Film \"rgb\" \"integer xresolutoin\" 3 WorldBegin",
        "Film \"rgb\" \"integer xresolution\" 3 \"integer xresolution\" 3 WorldBegin",
        "Accelerator \"bvh\" \"string splitmethd\" \"sah\" WorldBegin",
        "WorldBegin LookAt 0 0 0 0 1 0 0 1 0",
        "WorldBegin CoordSysTransform \"nowhere\"",
        "WorldBegin Translate 1e999 0 0",
        "WorldBegin Private",
        "WorldBegin WorldEnd Identity",
        "WorldBegin Shape \"heightfield2\"",
        "WorldBegin Shape \"spehre\"",
        "WorldBegin Shape \"sphere\" \"float raduis\" 1",
        "WorldBegin Shape \"sphere\" \"float radius\" 1 \"float radius\" 1",
        "WorldBegin Shape \"sphere\" \"float radius\" 0",
        "WorldBegin Scale 0 1 1 Shape \"sphere\"",
        "WorldBegin ActiveTransform EndTime Scale 2 2 2 Shape \"sphere\"",
        &format!("WorldBegin {mesh} \"texture alpha\" \"leaf\""),
        &format!("WorldBegin {mesh} \"texture displacement\" \"d\""),
        &format!("WorldBegin Scale 0 1 1 {mesh}"),
        "WorldBegin Shape \"trianglemesh\" \"point P\" [ 0 0 0 1 0 0 0 1e999 0 ]",
    ];
    for scene in scenes {
        let folder = Folder::new().with("a.pbrt", scene);
        folder
            .check("a.pbrt --strict")
            .exited(1)
            .said("warning: a.pbrt:1:");
        folder.check("a.pbrt").succeeded();
    }
    Folder::new().check("ball.pbrt --strict").succeeded();
    let folder = Folder::new()
        .with("a.pbrt", scenes[0])
        .with("bad.pbrt", "Shap");
    folder.check("a.pbrt bad.pbrt --strict").exited(65);
}
