//! One run of a program: wall-clock time, CPU time and memory as the system counts them.

use crate::Result;
use std::io::Read;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use wait4::Wait4;

/// A process that has ended well.
#[derive(Debug)]
pub(super) struct Ended {
    /// From before the start to after the exit.
    pub(super) wall: Duration,
    /// Of all threads, in programs and in the kernel.
    pub(super) cpu: Duration,
    /// The most that was resident. The kernel counts this process before it becomes the program,
    /// so this one must be small.
    pub(super) peak_bytes: u64,
    pub(super) output: Vec<u8>,
}

/// Runs a program to its end.
pub(super) fn run(command: &mut Command) -> Result<Ended> {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::inherit());
    let start = Instant::now();
    let mut child = command
        .spawn()
        .map_err(|error| format!("{}: {error}", command.get_program().display()))?;
    let mut output = Vec::new();
    if let Some(mut pipe) = child.stdout.take() {
        pipe.read_to_end(&mut output)?;
    }
    let end = child.wait4()?;
    let wall = start.elapsed();
    if !end.status.success() {
        return Err(format!("{command:?} ends with {}", end.status).into());
    }
    let usage = end.rusage;
    Ok(Ended {
        wall,
        cpu: usage.utime + usage.stime,
        peak_bytes: usage.maxrss,
        output,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_reported() {
        let ended = run(Command::new("echo").arg("a word")).unwrap();
        assert_eq!(ended.output, b"a word\n");
        assert!(ended.peak_bytes > 0 && ended.wall > Duration::ZERO);
        assert!(run(&mut Command::new("false")).is_err());
        assert!(run(&mut Command::new("/no such program")).is_err());
    }
}
