//! Results on standard output, and errors if it is closed or full.
#![cfg(unix)]

use crate::folder::Folder;
use std::process::{Command, Output, Stdio};

/// Runs the program with standard output redirected by a shell.
fn redirected(folder: &Folder, arguments: &str, to: &str) -> Output {
    let program = folder.command("").get_program().to_owned();
    let script = format!(r#"exec "$0" {arguments} {to}"#);
    Command::new("sh")
        .arg("-c")
        .arg(script)
        .arg(program)
        .current_dir(folder.path("."))
        .output()
        .unwrap()
}

const PRINTING: [&str; 11] = [
    "render ball.pbrt -o -",
    "render ball.pbrt -o b.exr --json",
    "check ball.pbrt",
    "check ball.pbrt --json",
    "compare a.exr a.exr",
    "pixel ball.pbrt 6,3",
    "tree ball.pbrt",
    "bench ball.pbrt --runs 1 --warmup 0 --accel sah --precision fast --reference none --csv r.csv",
    "completions bash",
    "--help",
    "--version",
];

fn folder() -> Folder {
    let folder = Folder::new();
    folder.render("ball.pbrt -o a.exr").succeeded();
    folder
}

#[test]
fn a_closed_standard_output_is_an_error_before_the_work() {
    let folder = folder();
    for arguments in PRINTING.into_iter().chain([
        "merge a.exr -o -",
        "render --help",
        "bench ball.pbrt --json",
    ]) {
        let output = redirected(&folder, arguments, ">&-");
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(74), "{arguments}: {stderr}");
        assert!(
            stderr.contains("error: standard output: cannot write: Bad file descriptor"),
            "{arguments}: {stderr}"
        );
    }
    assert_eq!(folder.images(), ["a.exr"], "nothing else was begun");
    // Other descriptors do not matter, nor does a standard output that is not needed.
    for (arguments, to) in [
        ("check ball.pbrt", "<&- 2>&-"),
        ("render ball.pbrt -o b.exr", ">&-"),
        ("check ball.pbrt -q", ">&-"),
        ("compare a.exr a.exr -q", ">&- <&-"),
    ] {
        assert_eq!(
            redirected(&folder, arguments, to).status.code(),
            Some(0),
            "{arguments} {to}"
        );
    }
}

#[test]
fn output_to_dev_null_is_no_error() {
    let folder = folder();
    for arguments in PRINTING {
        // Shells open it to write, Python's `subprocess.DEVNULL` and others to read and write.
        for to in [">/dev/null", "1<>/dev/null"] {
            assert_eq!(
                redirected(&folder, arguments, to).status.code(),
                Some(0),
                "{arguments} {to}"
            );
        }
    }
    let mut command = folder.subcommand("check", "ball.pbrt");
    assert!(command.stdout(Stdio::null()).status().unwrap().success());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error() {
    let folder = folder();
    for arguments in PRINTING {
        let output = redirected(&folder, arguments, ">/dev/full");
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(75), "{arguments}: {stderr}");
        assert!(
            stderr.contains("standard output: cannot write: No space left"),
            "{arguments}: {stderr}"
        );
    }
    assert_eq!(
        folder.text("r.csv").lines().count(),
        2,
        "files still get what was measured"
    );
}

#[test]
fn a_pager_that_closes_early_is_no_error() {
    let folder = Folder::new();
    for arguments in [
        "--help",
        "render --help",
        "--version",
        "check ball.pbrt ball.pbrt",
        "check ball.pbrt ball.pbrt --json",
    ] {
        let mut child = folder.subcommand("", "");
        let program = child.get_program().to_owned();
        child = Command::new(program);
        child
            .args(arguments.split_whitespace())
            .current_dir(folder.path("."))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = child.spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(
            (output.status.code(), output.stderr.as_slice()),
            (Some(0), &b""[..]),
            "{arguments}"
        );
    }
}
