//! Signals: which ones end the program, and what they leave.
#![cfg(unix)]

use crate::folder::Folder;
use signal_hook::consts::{
    SIGALRM, SIGHUP, SIGINT, SIGKILL, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU,
};
use signal_hook::low_level::signal_name;
use std::io::{PipeReader, PipeWriter, Write};
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Signals that the program catches.
const CAUGHT: [i32; 8] = [
    SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1, SIGUSR2, SIGALRM,
];

/// A film large enough that a signal usually arrives during the write.
const LARGE: &str = "ball.pbrt -o large.exr --resolution 800x800";

/// Attempts to interrupt a write.
const ATTEMPTS: usize = 20;

/// A timeout that no step here should reach.
const LIMIT: Duration = Duration::from_secs(120);

fn started(folder: &Folder, arguments: &str) -> Child {
    let mut command = without_core(&folder.command(arguments), "");
    command
        .current_dir(folder.path("."))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// The same command after a shell `script`, with default signals and without core dumps.
fn without_core(command: &Command, script: &str) -> Command {
    take_signals();
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("ulimit -c 0; {script} exec \"$@\""), "sh"]);
    shell.arg(command.get_program()).args(command.get_args());
    shell
}

/// Resets signals that this process inherited as ignored, as under `nohup`: programs inherit
/// ignored signals, but not handlers.
fn take_signals() {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .map_or("0", str::trim);
    let ignored = u64::from_str_radix(mask, 16).unwrap();
    for signal in CAUGHT
        .into_iter()
        .filter(|signal| ignored >> (signal - 1) & 1 == 1)
    {
        signal_hook::flag::register(signal, Arc::new(AtomicBool::new(false))).unwrap();
    }
}

/// The paths of files in `folder` that are being written: they have a temporary name or, on Linux,
/// none.
fn unfinished(folder: &Folder, child: &Child) -> Vec<String> {
    let folder_path = folder.path("").canonicalize().unwrap();
    let open = std::fs::read_dir(format!("/proc/{}/fd", child.id()))
        .into_iter()
        .flatten();
    let targets = open.filter_map(|entry| std::fs::read_link(entry.ok()?.path()).ok());
    let unnamed = targets.filter(|path| {
        path.starts_with(&folder_path) && path.to_string_lossy().ends_with(" (deleted)")
    });
    let unnamed = unnamed.map(|path| path.display().to_string());
    let named = folder
        .images()
        .into_iter()
        .filter(|name| name.starts_with(".feimos-"));
    named.chain(unnamed).collect()
}

fn wait_until(mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < LIMIT, "it never comes to that");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Sends `signal` after the program has begun to write, and waits for its end.
fn ended_while_writing(folder: &Folder, signal: i32) -> (ExitStatus, String) {
    for _ in 0..ATTEMPTS {
        let old = std::fs::read(folder.path("large.exr")).ok();
        let mut child = started(folder, LARGE);
        wait_until(|| {
            !unfinished(folder, &child).is_empty() || child.try_wait().unwrap().is_some()
        });
        if child.try_wait().unwrap().is_none() {
            send(signal, &child);
        }
        let output = child.wait_with_output().unwrap();
        if !output.status.success() {
            return (output.status, String::from_utf8(output.stderr).unwrap());
        }
        // It was faster than the signal.
        match old {
            Some(old) => std::fs::write(folder.path("large.exr"), old).unwrap(),
            None => std::fs::remove_file(folder.path("large.exr")).unwrap(),
        }
    }
    panic!("it is always faster than the signal");
}

/// Sends `signal`; a program that has just ended accepts it until it is waited for.
fn send(signal: i32, child: &Child) {
    let kill = format!("kill -{signal} {}", child.id());
    assert!(
        Command::new("sh")
            .args(["-c", &kill])
            .status()
            .unwrap()
            .success()
    );
}

#[test]
fn a_signal_ends_the_program_and_leaves_no_file() {
    for signal in CAUGHT {
        let folder = Folder::new().with("old.exr", "old");
        let (status, stderr) = ended_while_writing(&folder, signal);
        assert_eq!(status.signal(), Some(signal), "{stderr}");
        assert!(
            stderr.contains(&format!("ended by {}", signal_name(signal).unwrap())),
            "{stderr}"
        );
        assert_eq!(folder.images(), ["old.exr"]);
    }
}

/// A pipe that accepts no byte until it is read.
fn full_pipe() -> (PipeReader, PipeWriter) {
    let (reader, writer) = std::io::pipe().unwrap();
    let mut filler = writer.try_clone().unwrap();
    let filled = Arc::new(AtomicUsize::new(0));
    let count = filled.clone();
    // It waits with its last byte until the reader is gone.
    std::thread::spawn(move || {
        while filler.write_all(b".").is_ok() {
            count.fetch_add(1, Ordering::SeqCst);
        }
    });
    let mut before = 0;
    wait_until(|| {
        std::thread::sleep(Duration::from_millis(100));
        let now = filled.load(Ordering::SeqCst);
        std::mem::replace(&mut before, now) == now && now > 0
    });
    (reader, writer)
}

#[test]
fn a_signal_ends_the_program_if_nobody_reads_its_messages() {
    for signal in [SIGTERM, SIGINT, SIGHUP] {
        let folder = Folder::new();
        let (_unread, full) = full_pipe();
        let mut command = without_core(&folder.command("ball.pbrt -o a.exr"), "");
        command
            .current_dir(folder.path("."))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(full);
        let mut child = command.spawn().unwrap();
        drop(command);
        wait_until(|| folder.path("a.exr").exists());
        // By now it says what it has made, and waits.
        std::thread::sleep(Duration::from_millis(100));
        assert!(child.try_wait().unwrap().is_none());
        send(signal, &child);
        let start = Instant::now();
        while child.try_wait().unwrap().is_none() {
            if start.elapsed() > Duration::from_secs(10) {
                child.kill().unwrap();
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        assert_eq!(child.wait().unwrap().signal(), Some(signal));
    }
}

#[test]
fn a_kill_leaves_no_short_file() {
    let folder = Folder::new().with("large.exr", "old");
    let (status, _) = ended_while_writing(&folder, SIGKILL);
    assert_eq!(status.signal(), Some(SIGKILL));
    assert_eq!(folder.text("large.exr"), "old");
    // Where the file system has no files without a name, what it left is hidden, and in nobody's
    // way.
    if tempfile::tempfile_in(folder.path(".")).is_ok() && cfg!(target_os = "linux") {
        assert_eq!(folder.images(), ["large.exr"]);
    }
    folder.render("ball.pbrt -o large.exr").succeeded();
    assert_eq!(folder.exr("large.exr").size, (13, 7));
}

#[test]
fn an_ended_batch_keeps_finished_images() {
    let pose = |number: u32| {
        format!(r#"{{"name": "{number}", "lookat": [0, 0, -5, 0, 0, 0, 0, 1, {number}]}}"#)
    };
    let poses = format!("[{}]", (0..5000).map(pose).collect::<Vec<_>>().join(","));
    let folder = Folder::new().with("poses.json", poses);
    let child = started(
        &folder,
        "ball.pbrt --cameras poses.json -o {camera}.exr --manifest all.jsonl",
    );
    wait_until(|| folder.path("5.exr").exists());
    send(SIGTERM, &child);
    assert_eq!(
        child.wait_with_output().unwrap().status.signal(),
        Some(SIGTERM)
    );
    let (images, others): (Vec<String>, Vec<String>) = folder
        .images()
        .into_iter()
        .partition(|name| name.ends_with("exr"));
    assert!((6..5000).contains(&images.len()), "{}", images.len());
    assert_eq!(others, ["all.jsonl"]);
    assert!(images.iter().all(|name| folder.exr(name).size == (13, 7)));
    let lines = crate::folder::json_lines(&folder.text("all.jsonl"));
    assert!(
        lines.len().abs_diff(images.len()) <= 1,
        "{} lines of {} images",
        lines.len(),
        images.len()
    );
}

#[test]
fn a_signal_that_the_caller_ignores_is_ignored() {
    for signal in CAUGHT {
        let folder = Folder::new();
        // The shell starts it with the signal ignored, as `nohup` does, and a shell with what runs
        // in the background.
        let mut shell = without_core(&folder.command("- -o a.exr"), &format!("trap '' {signal};"));
        shell
            .current_dir(folder.path("."))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        let mut child = shell.spawn().unwrap();
        let name = format!("/proc/{}/comm", child.id());
        if cfg!(target_os = "linux") {
            wait_until(|| {
                std::fs::read_to_string(&name)
                    .unwrap()
                    .starts_with("feimos")
            });
        }
        send(signal, &child);
        drop(child.stdin.take());
        let output = child.wait_with_output().unwrap();
        // An empty scene is wrong: it has lived to see that.
        assert_eq!(
            output.status.code(),
            Some(65),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
}
