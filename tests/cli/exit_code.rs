//! One exit code for each kind of failure.

use crate::folder::{BALL, Folder, WARNED};
use std::fs;

#[test]
fn warnings_alone_are_not_a_failure() {
    Folder::new()
        .with("warned.pbrt", WARNED)
        .render("warned.pbrt --resolution 2x2")
        .succeeded()
        .said("warning: ");
}

#[test]
fn strict_makes_warnings_a_failure_after_the_image_is_written() {
    let folder = Folder::new().with("warned.pbrt", WARNED);
    folder
        .render("warned.pbrt --strict --resolution 2x2")
        .exited(1)
        .said("warning: ");
    assert_eq!(folder.images(), ["pbrt.exr"]);
    folder.render("ball.pbrt --strict").succeeded();
}

#[test]
fn usage() {
    let folder = Folder::new();
    for arguments in [
        "",
        "ball.pbrt --no-such-flag",
        "ball.pbrt -o a.jpg",
        "ball.pbrt -o a",
        "--resolution 2 ball.pbrt",
    ] {
        folder.render(arguments).exited(2);
    }
    assert!(folder.images().is_empty());
}

#[test]
fn bad_input() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n";
    let folder = Folder::new()
        .with("bad.ply", ply)
        .with("none.pbrt", "")
        .with("binary.pbrt", [0, 1, 2, 0]);
    for scene in ["bad.ply", "none.pbrt", "binary.pbrt"] {
        folder.render(scene).failed(65, scene);
    }
    assert!(folder.images().is_empty());
}

#[test]
fn missing_input() {
    let folder = Folder::new()
        .with(
            "mesh.pbrt",
            "WorldBegin\nShape \"plymesh\" \"string filename\" \"gone.ply\"\n",
        )
        .with("include.pbrt", "Include \"gone.pbrt\"\n");
    for scene in ["gone.pbrt", "gone.ply", "mesh.pbrt", "include.pbrt"] {
        folder.render(scene).failed(66, "cannot read");
    }
    folder
        .render(".")
        .failed(66, "this is a folder, not a file");
}

#[test]
fn a_directory_or_a_file_in_the_way() {
    let folder = Folder::new();
    fs::create_dir(folder.path("a.exr")).unwrap();
    folder
        .render("ball.pbrt -o a.exr")
        .failed(73, "a.exr: cannot create");
    folder
        .render("ball.pbrt -o ball.pbrt/a.exr")
        .failed(73, "ball.pbrt/a.exr: cannot create");
    let run = folder
        .render("ball.pbrt -o ball.pbrt/deep/a.exr")
        .exited(73);
    let expected = "error: ball.pbrt/deep: cannot create: Not a directory (os error 20)\n";
    assert_eq!(run.stderr, expected);
    folder
        .render("ball.pbrt --manifest ball.pbrt/a.jsonl")
        .failed(73, "ball.pbrt/a.jsonl: cannot create");
}

#[test]
fn output_errors_are_found_before_the_tree_is_built() {
    let folder = Folder::new();
    for output in ["ball.pbrt/a.exr", "a.jpg", "a"] {
        folder
            .render(&format!("ball.pbrt -v -o {output}"))
            .did_not_say("built ");
    }
    folder
        .render("gone.pbrt -o a.jpg")
        .failed(2, "unknown image format `.jpg`");
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::symlink;

    fn render_to_nobody(folder: &Folder, arguments: &str) -> std::process::Output {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let command = &mut folder.command(arguments);
        command
            .stdout(writer)
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap()
            .wait_with_output()
            .unwrap()
    }

    #[test]
    fn a_closed_reader_of_the_image_is_an_error() {
        let folder = Folder::new();
        for arguments in [
            "ball.pbrt -o -",
            "ball.pbrt -o - --view hit",
            "ball.pbrt --json",
        ] {
            let output = render_to_nobody(&folder, arguments);
            assert_eq!(output.status.code(), Some(74), "{arguments}");
            let stderr = String::from_utf8(output.stderr).unwrap();
            assert!(
                stderr.contains("error: standard output: cannot write: "),
                "{stderr}"
            );
        }
    }

    #[test]
    fn a_closed_reader_without_output_is_no_error() {
        assert_eq!(
            render_to_nobody(&Folder::new(), "ball.pbrt").status.code(),
            Some(0)
        );
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_full_disk_is_a_temporary_failure() {
        let folder = Folder::new();
        symlink("/dev/full", folder.path("a.exr")).unwrap();
        folder
            .render("ball.pbrt -o a.exr")
            .failed(75, "a.exr: cannot write: ");
    }

    #[test]
    fn the_umask_decides_who_may_read_a_new_image() {
        use std::os::unix::fs::PermissionsExt;
        let folder = Folder::new();
        for (umask, expected) in [("022", 0o644), ("077", 0o600), ("002", 0o664)] {
            let script = format!("umask {umask}; exec \"$@\" -o {umask}.exr");
            let render = folder.command("ball.pbrt");
            let mut shell = std::process::Command::new("sh");
            shell
                .current_dir(folder.path(""))
                .args(["-c", &script, "sh"])
                .arg(render.get_program());
            assert!(
                shell
                    .args(render.get_args())
                    .output()
                    .unwrap()
                    .status
                    .success()
            );
            let mode = fs::metadata(folder.path(&format!("{umask}.exr")))
                .unwrap()
                .permissions()
                .mode();
            assert_eq!(mode & 0o777, expected, "umask {umask}");
        }
    }

    #[test]
    fn an_output_is_written_through_its_link() {
        let folder = Folder::new();
        symlink("real.exr", folder.path("a.exr")).unwrap();
        folder.render("ball.pbrt -o a.exr").succeeded();
        assert!(folder.path("a.exr").is_symlink());
        assert_eq!(folder.exr("real.exr").size, (13, 7));
    }
}

#[test]
fn errors_of_a_scene_on_standard_input_are_reported() {
    Folder::new()
        .render_input("-", &BALL.replace("Shape", "Shap"))
        .failed(65, "-:6:1: unknown directive `Shap`");
}

#[test]
fn standard_input_is_read_only_if_it_is_named() {
    for part in [
        "Include \"-\"",
        "WorldBegin Shape \"plymesh\" \"string filename\" \"-\"",
    ] {
        Folder::new()
            .with("a.pbrt", part)
            .render("a.pbrt")
            .failed(66, "-: cannot read");
    }
}
