//! Two images in one place, and places that cannot be written to.

use crate::folder::{BALL, Folder};
use std::fs;

fn two() -> Folder {
    Folder::new().with("second.pbrt", BALL.replace("film.exr", "sub/../film.exr"))
}

#[test]
fn two_names_of_one_image_are_refused_before_the_work() {
    let folder = two();
    fs::create_dir(folder.path("sub")).unwrap();
    folder
        .render("ball.pbrt second.pbrt")
        .failed(2, "would both be written to sub/../film.exr");
    folder
        .render("ball.pbrt sub/../ball.pbrt -o {stem}.exr")
        .failed(2, "would both be written to ball.exr");
    assert!(!folder.path("film.exr").exists());
}

#[cfg(unix)]
#[test]
fn links_to_one_image_are_refused_before_the_work() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new();
    fs::create_dir(folder.path("real")).unwrap();
    symlink("real", folder.path("link")).unwrap();
    symlink("real/new.exr", folder.path("new.exr")).unwrap();
    let named = |name: &str| BALL.replace("film.exr", name);
    let folder = folder
        .with("a.pbrt", named("real/x.exr"))
        .with("b.pbrt", named("link/x.exr"));
    let folder = folder
        .with("c.pbrt", named("real/new.exr"))
        .with("d.pbrt", named("new.exr"));
    folder
        .render("a.pbrt b.pbrt")
        .failed(2, "would both be written to link/x.exr");
    folder
        .render("c.pbrt d.pbrt")
        .failed(2, "would both be written to new.exr");
    folder.render("a.pbrt").succeeded();
    symlink("all.jsonl", folder.path("m.exr")).unwrap();
    let message = "all.jsonl: the manifest and the image of a.pbrt would be one file";
    folder
        .render("a.pbrt -o m.exr --manifest all.jsonl")
        .failed(2, message);
    assert!(!folder.path("all.jsonl").exists());
    fs::hard_link(folder.path("real/x.exr"), folder.path("film.exr")).unwrap();
    folder
        .render("ball.pbrt a.pbrt --force")
        .failed(2, "would both be written to real/x.exr");
}

#[test]
fn an_image_with_a_late_name_does_not_replace_one_of_the_batch() {
    let folder = Folder::new();
    let run = folder
        .render_input("ball.pbrt - --force", BALL)
        .failed(2, "ball.pbrt and - would both be written to film.exr");
    run.said("1 of 2 scenes failed");
}

#[test]
fn a_folder_in_the_place_of_a_file_is_refused() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -v -o a.exr/.")
        .failed(73, "cannot create")
        .did_not_say("loaded ");
    folder.render("ball.pbrt -o a.exr").succeeded();
    folder
        .render("ball.pbrt -v -o a.exr/")
        .failed(73, "a.exr/ball.exr: cannot create: Not a directory")
        .did_not_say("loaded ");
}

#[test]
fn missing_folders_are_made_for_every_output() {
    let folder = Folder::new();
    let cameras = folder.path("a").join("b");
    folder
        .render("ball.pbrt -o a/b/c.exr --manifest log/all.jsonl")
        .succeeded();
    assert!(cameras.join("c.exr").is_file());
    assert_eq!(folder.text("log/all.jsonl").lines().count(), 1);
    folder
        .bench(
            "ball.pbrt --runs 1 --warmup 0 --accel sah --precision fast --reference none \
             --csv rows/a.csv",
        )
        .succeeded();
    assert!(folder.path("rows/a.csv").is_file());
    folder
        .compare("a/b/c.exr a/b/c.exr --diff diff/d.png")
        .succeeded();
    assert!(folder.path("diff/d.png").is_file());
    folder.merge("a/b/c.exr -o whole/c.exr").succeeded();
    assert_eq!(folder.bytes("whole/c.exr"), folder.bytes("a/b/c.exr"));
}

#[test]
fn a_failed_render_leaves_no_folder() {
    let folder = Folder::new().with("bad.pbrt", "Shap");
    folder
        .render("bad.pbrt -o out/deep/a.exr")
        .failed(65, "bad.pbrt:1");
    folder
        .render("ball.pbrt -o out/a.png --view depth16 --scale 1e5")
        .failed(2, "does not fit");
    folder
        .render("ball.pbrt -o out/a.exr --pixelbounds 90,91,0,1")
        .failed(2, "holds no pixel");
    assert!(!folder.path("out").exists());
}

#[test]
fn spellings_of_a_missing_folder_are_one_place() {
    let folder = Folder::new().with("other.pbrt", BALL);
    folder
        .render("ball.pbrt -o out/a.exr -o out/b/../a.exr")
        .failed(2, "two outputs would both be written to out/b/../a.exr");
    assert!(!folder.path("out").exists());
}

#[cfg(target_os = "linux")]
mod rights {
    use super::*;
    use crate::folder::Run;
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    use std::process::Command;

    fn set_mode(folder: &Folder, name: &str, mode: u32) {
        fs::set_permissions(folder.path(name), fs::Permissions::from_mode(mode)).unwrap();
    }

    /// Runs the program without the privileges of root; `None` if that is not possible.
    fn without_rights(folder: &Folder, arguments: &str) -> Option<Run> {
        let program = folder.command("");
        let mut command = match fs::metadata(folder.path(".")).unwrap().uid() {
            0 => {
                let mut command = Command::new("setpriv");
                command
                    .args(["--reuid=65534", "--regid=65534", "--clear-groups"])
                    .arg(program.get_program());
                command
            }
            _ => Command::new(program.get_program()),
        };
        let output = command
            .args(arguments.split_whitespace())
            .current_dir(folder.path("."))
            .output()
            .ok()?;
        let stderr = String::from_utf8(output.stderr).unwrap();
        let is_started = !stderr.contains("setpriv");
        is_started.then(|| Run {
            code: output.status.code().unwrap(),
            stdout: output.stdout,
            stderr,
        })
    }

    #[test]
    fn a_folder_without_write_permission_is_found_before_the_render() {
        let folder = Folder::new();
        fs::create_dir(folder.path("closed")).unwrap();
        set_mode(&folder, "closed", 0o555);
        set_mode(&folder, ".", 0o755);
        let scene = BALL.replace("film.exr", "closed/film.exr");
        let folder = folder.with("film.pbrt", scene).with("r.csv", "");
        set_mode(&folder, "r.csv", 0o444);
        for arguments in [
            "render ball.pbrt -v -o closed/a.exr",
            "render film.pbrt -v",
            "bench ball.pbrt -v --csv closed/a.csv",
        ] {
            let Some(run) = without_rights(&folder, arguments) else {
                return;
            };
            run.failed(73, "cannot create: Permission denied")
                .did_not_say("built ");
        }
        for arguments in [
            "bench ball.pbrt -v --csv r.csv",
            "bench ball.pbrt -v --report closed/new",
        ] {
            let Some(run) = without_rights(&folder, arguments) else {
                return;
            };
            run.failed(73, "cannot create: Permission denied")
                .did_not_say("loaded ");
        }
        set_mode(&folder, "closed", 0o755);
    }

    #[test]
    fn a_file_of_another_user_in_a_sticky_folder_is_found_before_the_render() {
        let folder = Folder::new();
        fs::create_dir(folder.path("all")).unwrap();
        set_mode(&folder, "all", 0o1777);
        set_mode(&folder, ".", 0o755);
        let folder = folder.with("all/a.exr", "old");
        set_mode(&folder, "all/a.exr", 0o666);
        if fs::metadata(folder.path(".")).unwrap().uid() != 0 {
            return;
        }
        let Some(run) = without_rights(&folder, "render ball.pbrt -v -o all/a.exr") else {
            return;
        };
        run.failed(
            73,
            "all/a.exr: cannot create: the file and its folder belong to another user",
        )
        .did_not_say("loaded ");
        assert_eq!(folder.text("all/a.exr"), "old");
    }
}
