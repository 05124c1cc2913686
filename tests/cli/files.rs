//! What stands under the final name, whatever happens on the way.
#![cfg(unix)]

use crate::folder::Folder;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Large enough to be caught while it is written.
const LARGE: &str = "ball.pbrt -o large.exr --resolution 4000x4000 --accel none";

/// Gives up: nothing here takes so long.
const LIMIT: Duration = Duration::from_secs(120);

fn started(folder: &Folder, arguments: &str) -> Child {
    folder.command(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Names of files that are being written.
fn unfinished(folder: &Folder) -> Vec<String> {
    folder.images().into_iter().filter(|name| name.starts_with(".feimos-")).collect()
}

/// Sends `signal` when the program has begun to write, and waits for its end.
fn ended_while_writing(folder: &Folder, signal: &str) -> (ExitStatus, String) {
    let child = started(folder, LARGE);
    let start = Instant::now();
    while unfinished(folder).is_empty() {
        assert!(start.elapsed() < LIMIT, "it never writes");
        std::thread::sleep(Duration::from_millis(1));
    }
    send(signal, &child);
    let output = child.wait_with_output().unwrap();
    (output.status, String::from_utf8(output.stderr).unwrap())
}

fn send(signal: &str, child: &Child) {
    let sent = Command::new("sh").args(["-c", &format!("kill -{signal} {}", child.id())]).status().unwrap();
    assert!(sent.success());
}

#[test]
fn a_signal_ends_it_without_a_trace() {
    for (signal, number) in [("TERM", 15), ("INT", 2)] {
        let folder = Folder::new().with("old.exr", "old");
        let (status, stderr) = ended_while_writing(&folder, signal);
        assert_eq!(status.signal(), Some(number), "{stderr}");
        assert!(stderr.contains(&format!("ended by SIG{signal}")), "{stderr}");
        assert_eq!(folder.images(), ["old.exr"]);
    }
}

#[test]
fn a_kill_leaves_no_short_file() {
    let folder = Folder::new().with("large.exr", "old");
    let (status, _) = ended_while_writing(&folder, "KILL");
    assert_eq!(status.signal(), Some(9));
    assert_eq!(folder.text("large.exr"), "old");
    // What it left is hidden, and in nobody's way.
    folder.render("ball.pbrt -o large.exr").succeeded();
    assert_eq!(folder.exr("large.exr").size, (13, 7));
}

#[test]
fn a_batch_that_is_ended_keeps_what_was_finished() {
    let pose = |number: u32| format!(r#"{{"name": "{number}", "lookat": [0, 0, -5, 0, 0, 0, 0, 1, {number}]}}"#);
    let poses = format!("[{}]", (0..5000).map(pose).collect::<Vec<_>>().join(","));
    let folder = Folder::new().with("poses.json", poses);
    let arguments = "ball.pbrt --cameras poses.json -o {camera}.exr --manifest all.jsonl";
    let child = started(&folder, arguments);
    let start = Instant::now();
    while !folder.path("5.exr").exists() {
        assert!(start.elapsed() < LIMIT, "it never writes");
        std::thread::sleep(Duration::from_millis(1));
    }
    send("TERM", &child);
    assert_eq!(child.wait_with_output().unwrap().status.signal(), Some(15));
    let images: Vec<String> = folder.images().into_iter().filter(|name| name.ends_with("exr")).collect();
    assert!((6..5000).contains(&images.len()) && unfinished(&folder).is_empty(), "{}", images.len());
    assert!(images.iter().all(|name| folder.exr(name).size == (13, 7)));
    let lines = crate::folder::json_lines(&folder.text("all.jsonl"));
    assert!(lines.len().abs_diff(images.len()) <= 1, "{} lines of {} images", lines.len(), images.len());
}

#[test]
fn a_signal_that_the_caller_ignores_is_ignored() {
    let folder = Folder::new();
    let program = folder.command("").get_program().to_owned();
    let mut shell = Command::new("sh");
    // The shell starts it with the signal ignored, as it does with what runs in the background.
    let script = r#"trap '' INT; "$0" render - -o a.exr & kill -INT $!; wait $!"#;
    shell.arg("-c").arg(script).arg(program).current_dir(folder.path(".")).stdin(Stdio::piped());
    let mut child = shell.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdin.take());
    let output = child.wait_with_output().unwrap();
    // An empty scene is wrong: it has lived to see that.
    assert_eq!(output.status.code(), Some(65), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn two_processes_that_write_one_file_leave_one_whole_file() {
    let folder = Folder::new();
    for _ in 0..3 {
        let children: Vec<Child> = (0..4)
            .map(|number| started(&folder, &format!("ball.pbrt -o same.exr --resolution {0}x{0}", 300 + number)))
            .collect();
        for child in children {
            assert!(child.wait_with_output().unwrap().status.success());
        }
        let image = folder.exr("same.exr");
        let side = image.film.0;
        assert!((300..304).contains(&side) && image.film == (side, side));
        folder.render(&format!("ball.pbrt -o alone.exr --resolution {side}x{side}")).succeeded();
        assert!(folder.bytes("same.exr") == folder.bytes("alone.exr"));
        assert!(unfinished(&folder).is_empty());
    }
}

#[test]
fn a_closed_standard_output_is_an_error() {
    let folder = Folder::new();
    for arguments in ["ball.pbrt -o - --resolution 500x500", "ball.pbrt -o a.png --json"] {
        let mut child = folder.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(74), "{stderr}");
        assert!(stderr.contains("standard output: cannot write: Broken pipe"), "{stderr}");
    }
    assert!(folder.images().iter().all(|name| name == "a.png"));
}

#[test]
fn a_full_device_may_be_tried_again() {
    let folder = Folder::new();
    for name in ["a.exr", "a.png", "a.npy", "a.pfm"] {
        std::os::unix::fs::symlink("/dev/full", folder.path(name)).unwrap();
        folder.render(&format!("ball.pbrt -o {name}")).failed(75, "No space left on device");
    }
}

/// A folder that is a file system of its own: it needs the rights to make one.
struct Mounted<'a>(&'a Folder);

impl Mounted<'_> {
    fn new<'a>(folder: &'a Folder, options: &str) -> Mounted<'a> {
        let path = folder.path("disk");
        std::fs::create_dir(&path).unwrap();
        let status = Command::new("mount").args(["-t", "tmpfs", "-o", options, "tmpfs"]).arg(&path).status().unwrap();
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
fn a_full_disk_leaves_no_short_file_and_may_be_tried_again() {
    let folder = Folder::new();
    let disk = Mounted::new(&folder, "size=64k");
    for name in ["a.exr", "a.png --view normal", "a.npy", "a.pfm"] {
        let run = folder.render(&format!("ball.pbrt --resolution 1200x1200 -o disk/{name}")).exited(75);
        assert!(run.stderr.contains("cannot write: No space left on device"), "{}", run.stderr);
        assert_eq!(disk.files(), 0, "{name}");
    }
    folder.render("ball.pbrt -o disk/small.exr").succeeded();
    folder.render("ball.pbrt -o large.exr --resolution 1200x1200").succeeded();
    folder.merge("large.exr -o disk/small.exr").exited(75);
    assert_eq!(folder.exr("disk/small.exr").size, (13, 7), "the old one is still there");
}

#[test]
#[ignore = "mounts a small file system: needs root"]
fn a_read_only_folder_is_no_place_for_an_image() {
    let folder = Folder::new();
    let disk = Mounted::new(&folder, "ro");
    for name in ["a.exr", "a.png", "a.npy", "a.pfm"] {
        folder.render(&format!("ball.pbrt -o disk/{name}")).failed(73, "cannot create: Read-only file system");
    }
    folder.render("ball.pbrt --manifest disk/a.jsonl").failed(73, "disk/a.jsonl: cannot create");
    assert_eq!(disk.files(), 0);
}
