//! Output files are complete or absent, whatever happens while the program writes them.
#![cfg(unix)]

use crate::folder::Folder;
#[cfg(target_os = "linux")]
use std::os::unix::fs::PermissionsExt;
#[cfg(target_os = "linux")]
use std::process::Output;
use std::process::{Child, Command, Stdio};

fn started(folder: &Folder, arguments: &str) -> Child {
    folder
        .command(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

#[test]
fn two_processes_that_write_one_file_leave_one_complete_file() {
    let folder = Folder::new();
    for _ in 0..3 {
        let children: Vec<Child> = (0..4)
            .map(|number| {
                started(
                    &folder,
                    &format!("ball.pbrt -o same.exr --resolution {0}x{0}", 300 + number),
                )
            })
            .collect();
        for child in children {
            assert!(child.wait_with_output().unwrap().status.success());
        }
        let image = folder.exr("same.exr");
        let side = image.film.0;
        assert!((300..304).contains(&side) && image.film == (side, side));
        folder
            .render(&format!(
                "ball.pbrt -o alone.exr --resolution {side}x{side}"
            ))
            .succeeded();
        assert!(folder.bytes("same.exr") == folder.bytes("alone.exr"));
        assert_eq!(folder.images(), ["alone.exr", "same.exr"]);
    }
}

/// Runs `feimos render` with `arguments` under a limit of the shell (`ulimit`).
fn limited(folder: &Folder, limit: &str, arguments: &str) -> (Option<i32>, String) {
    let mut shell = Command::new("sh");
    shell
        .current_dir(folder.path("."))
        .args(["-c", &format!("ulimit {limit}; exec \"$@\""), "sh"]);
    let command = folder.command(arguments);
    let output = shell
        .arg(command.get_program())
        .args(command.get_args())
        .output()
        .unwrap();
    (
        output.status.code(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

#[test]
fn a_file_beyond_the_size_limit_is_an_error() {
    for before in ["", "trap '' XFSZ; "] {
        let folder = Folder::new().with("old.exr", "old");
        for name in ["new.exr", "old.exr", "new.npy", "new.pfm"] {
            let limit = format!("-c 0; {before}ulimit -f 8");
            let (code, stderr) = limited(
                &folder,
                &limit,
                &format!("ball.pbrt --resolution 300x300 -o {name}"),
            );
            assert_eq!(code, Some(74), "{stderr}");
            assert!(
                stderr.contains(&format!("{name}: cannot write: File too large")),
                "{stderr}"
            );
            assert!(
                stderr.contains("raise the limit on the size of files (`ulimit -f`)"),
                "{stderr}"
            );
        }
        assert_eq!(folder.images(), ["old.exr"]);
        assert_eq!(folder.text("old.exr"), "old");
    }
}

/// Commands, and whether each must tell that the system refuses threads.
#[cfg(target_os = "linux")]
const THREADED: [(&str, bool); 7] = [
    (
        "render ball.pbrt -o found.exr --threads 8 --progress always",
        true,
    ),
    ("render ball.pbrt -o found.exr --threads 8 -q", false),
    ("check ball.pbrt --threads 8 --progress always", true),
    ("pixel ball.pbrt 6,3 --threads 8", true),
    (
        "bench ball.pbrt --threads 8 --runs 1 --warmup 0 --accel sah --report page",
        true,
    ),
    ("compare expected.exr found.exr", false),
    ("merge expected.exr -o found.exr --threads 8", true),
];

/// Runs `command` as `user`, who may have `threads` threads, including the main one.
#[cfg(target_os = "linux")]
fn run_with_threads(folder: &Folder, user: u32, threads: u32, command: &str) -> Output {
    let shell = format!("ulimit -u {threads}; exec ./feimos {command}");
    Command::new("setpriv")
        .current_dir(folder.path("."))
        .args(["--reuid", &user.to_string(), "--clear-groups"])
        .args(["bash", "-c", &shell])
        .output()
        .unwrap()
}

#[test]
#[cfg(target_os = "linux")]
#[ignore = "becomes a user whose threads nobody else counts: needs root"]
fn fewer_threads_work_if_the_system_refuses_some() {
    let folder = Folder::new();
    std::fs::copy(folder.command("").get_program(), folder.path("feimos")).unwrap();
    std::fs::set_permissions(folder.path("."), PermissionsExt::from_mode(0o777)).unwrap();
    folder
        .render("ball.pbrt -o expected.exr --threads 8")
        .succeeded();
    for (user, threads) in (50_000..).zip([1, 2, 3, 5]) {
        for (command, has_note) in THREADED {
            let output = run_with_threads(&folder, user, threads, command);
            let stderr = String::from_utf8(output.stderr).unwrap();
            assert_eq!(
                output.status.code(),
                Some(0),
                "{threads} threads, {command}: {stderr}"
            );
            assert_eq!(
                stderr.contains("note: the system refuses 8 threads"),
                has_note,
                "{command}: {stderr}"
            );
            if command.contains("found.exr") {
                assert!(
                    folder.bytes("found.exr") == folder.bytes("expected.exr"),
                    "{command}"
                );
            }
        }
        std::fs::remove_file(folder.path("found.exr")).unwrap();
        std::fs::remove_dir_all(folder.path("page")).unwrap();
    }
}

#[test]
fn a_closed_standard_output_is_an_error() {
    let folder = Folder::new();
    for arguments in [
        "ball.pbrt -o - --resolution 500x500",
        "ball.pbrt -o a.png --json",
    ] {
        let mut child = folder
            .command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(74), "{stderr}");
        assert!(
            stderr.contains("standard output: cannot write: Broken pipe"),
            "{stderr}"
        );
    }
    assert!(folder.images().iter().all(|name| name == "a.png"));
}

#[test]
fn a_full_device_is_a_temporary_failure() {
    let folder = Folder::new();
    for name in ["a.exr", "a.png", "a.npy", "a.pfm"] {
        std::os::unix::fs::symlink("/dev/full", folder.path(name)).unwrap();
        folder
            .render(&format!("ball.pbrt -o {name}"))
            .failed(75, "No space left on device");
    }
}

/// A folder that is its own file system; making one needs privileges.
struct Mounted<'a>(&'a Folder);

impl Mounted<'_> {
    fn new<'a>(folder: &'a Folder, options: &str) -> Mounted<'a> {
        let path = folder.path("disk");
        std::fs::create_dir(&path).unwrap();
        let status = Command::new("mount")
            .args(["-t", "tmpfs", "-o", options, "tmpfs"])
            .arg(&path)
            .status()
            .unwrap();
        assert!(status.success(), "run this as root");
        Mounted(folder)
    }

    fn files(&self) -> usize {
        std::fs::read_dir(self.0.path("disk")).unwrap().count()
    }
}

impl Drop for Mounted<'_> {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.0.path("disk")).status();
    }
}

#[test]
#[ignore = "mounts a small file system: needs root"]
fn a_full_disk_leaves_no_short_file_and_is_a_temporary_failure() {
    let folder = Folder::new();
    let disk = Mounted::new(&folder, "size=64k");
    for name in ["a.exr", "a.png --view normal", "a.npy", "a.pfm"] {
        let run = folder
            .render(&format!("ball.pbrt --resolution 1200x1200 -o disk/{name}"))
            .exited(75);
        assert!(
            run.stderr.contains("cannot write: No space left on device"),
            "{}",
            run.stderr
        );
        assert_eq!(disk.files(), 0, "{name}");
    }
    folder.render("ball.pbrt -o disk/small.exr").succeeded();
    folder
        .render("ball.pbrt -o large.exr --resolution 1200x1200")
        .succeeded();
    folder.merge("large.exr -o disk/small.exr").exited(75);
    assert_eq!(
        folder.exr("disk/small.exr").size,
        (13, 7),
        "the old one is still there"
    );
}

#[test]
#[ignore = "mounts a small file system: needs root"]
fn a_read_only_folder_is_an_error() {
    let folder = Folder::new();
    let disk = Mounted::new(&folder, "ro");
    for name in ["a.exr", "a.png", "a.npy", "a.pfm"] {
        folder
            .render(&format!("ball.pbrt -o disk/{name}"))
            .failed(73, "cannot create: Read-only file system");
    }
    folder
        .render("ball.pbrt --manifest disk/a.jsonl")
        .failed(73, "disk/a.jsonl: cannot create");
    assert_eq!(disk.files(), 0);
}
