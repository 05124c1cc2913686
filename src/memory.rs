//! The memory that the process may still take, as far as the system says.
//!
//! Linux promises more memory than it has, and ends the process that uses it. So large sizes are
//! first compared with what is left: free memory, and the limits of control groups and of the
//! process.

use crate::error::{Diagnostic, Error, ErrorKind, Result, grouped};
use std::fs;
use std::path::{Path, PathBuf};

/// The bytes that the process may still take; `None` if the system does not say.
pub(crate) fn available() -> Option<u64> {
    let limits = [free(), left_of_groups(), left_of_address_space()];
    limits.into_iter().flatten().min()
}

/// Refuses `bytes` of memory if less is left; `message` describes the data.
///
/// # Errors
/// A temporary error: other programs may end, and limits may be raised.
pub(crate) fn check(bytes: u64, message: impl FnOnce() -> String) -> Result<()> {
    // Small sizes are not worth the check.
    const SMALL: u64 = 32 << 20;
    match available() {
        _ if bytes < SMALL => Ok(()),
        Some(available) if bytes > available => Err(refusal(bytes, available, message())),
        _ => Ok(()),
    }
}

fn refusal(bytes: u64, available: u64, message: String) -> Error {
    let found = format!(
        "it takes {} of memory, and {} are to be had",
        words(bytes),
        words(available)
    );
    Error::new(ErrorKind::TryAgain, Diagnostic::new(message).note(found))
}

fn words(bytes: u64) -> String {
    format!("{} MB", grouped(bytes.div_ceil(1 << 20)))
}

/// Free memory and swap space of the machine.
fn free() -> Option<u64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let memory = kilobytes(&text, "MemAvailable:")?;
    Some(memory.saturating_add(kilobytes(&text, "SwapFree:").unwrap_or(0)))
}

/// The size, in bytes, in the line of `text` that begins with `name`.
fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let number = text.lines().find_map(|line| line.strip_prefix(name))?;
    number
        .trim()
        .strip_suffix("kB")?
        .trim()
        .parse::<u64>()
        .ok()?
        .checked_mul(1024)
}

/// What the process's control groups leave of their limits.
fn left_of_groups() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    let left = groups.lines().filter_map(|line| {
        let mut fields = line.splitn(3, ':');
        let (number, controllers, path) = (fields.next()?, fields.next()?, fields.next()?);
        let is_first_version = controllers
            .split(',')
            .any(|controller| controller == "memory");
        match (number, is_first_version) {
            ("0", false) => left_in("/sys/fs/cgroup", path, ["memory.max", "memory.current"]),
            (_, true) => left_in(
                "/sys/fs/cgroup/memory",
                path,
                ["memory.limit_in_bytes", "memory.usage_in_bytes"],
            ),
            _ => None,
        }
    });
    left.min()
}

/// The least that the group `path` below `root`, or one of its parents, leaves.
fn left_in(root: &str, path: &str, names: [&str; 2]) -> Option<u64> {
    let root = Path::new(root);
    // In a container the path may be the host's: then only the root exists.
    let mut group: PathBuf = root.join(path.trim_start_matches('/'));
    let mut least = left_of_group(&group, names);
    while group != root && group.pop() {
        least = least.into_iter().chain(left_of_group(&group, names)).min();
    }
    least
}

fn left_of_group(group: &Path, [limit, usage]: [&str; 2]) -> Option<u64> {
    let number = |name: &str| {
        fs::read_to_string(group.join(name))
            .ok()?
            .trim()
            .parse::<u64>()
            .ok()
    };
    // Without a limit the file says `max`, or a number close to 2^63.
    let limit = number(limit).filter(|limit| *limit < 1 << 60)?;
    // Cached files are dropped on demand.
    let cached = fs::read_to_string(group.join("memory.stat")).map_or(0, |statistics| {
        let bytes = |name: &str| {
            statistics
                .lines()
                .find_map(|line| line.strip_prefix(name)?.trim().parse::<u64>().ok())
        };
        bytes("inactive_file ")
            .unwrap_or(0)
            .saturating_add(bytes("active_file ").unwrap_or(0))
    });
    Some(limit.saturating_sub(number(usage)?.saturating_sub(cached)))
}

/// What `ulimit -v` leaves.
fn left_of_address_space() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let limit = limits
        .lines()
        .find_map(|line| line.strip_prefix("Max address space"))?;
    let limit: u64 = limit.split_whitespace().next()?.parse().ok()?;
    let status = fs::read_to_string("/proc/self/status").ok()?;
    Some(limit.saturating_sub(kilobytes(&status, "VmSize:")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_much_is_refused_and_little_is_not() {
        assert!(check(1000, || "a".to_owned()).is_ok());
        if available().is_some() {
            let error = check(1 << 62, || "an image".to_owned()).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::TryAgain);
            assert!(
                error
                    .to_string()
                    .starts_with("an image\n   = it takes 4,398,046,511,104 MB of memory, and "),
                "{error}"
            );
        }
    }

    #[test]
    fn the_innermost_group_that_is_tight_counts() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        fs::create_dir_all(root.join("a/b")).unwrap();
        let write = |name: &str, text: &str| fs::write(root.join(name), text).unwrap();
        let names = ["memory.max", "memory.current"];
        let left = |path| left_in(root.to_str().unwrap(), path, names);
        assert_eq!(left("/a/b"), None);
        write("a/b/memory.max", "max\n");
        write("a/b/memory.current", "10\n");
        assert_eq!(left("/a/b"), None);
        write("a/memory.max", "1000\n");
        write("a/memory.current", "900\n");
        write(
            "a/memory.stat",
            "anon 5\nfile 99\ninactive_file 30\nactive_file 40\n",
        );
        assert_eq!(left("/a/b"), Some(170));
        write("memory.max", "100\n");
        write("memory.current", "50\n");
        assert_eq!(left("/a/b"), Some(50));
        assert_eq!(left("/elsewhere/gone"), Some(50));
    }

    #[test]
    fn numbers_of_the_system_are_read() {
        assert_eq!(
            kilobytes("MemFree: 1 kB\nMemAvailable:   12 kB\n", "MemAvailable:"),
            Some(12_288)
        );
        assert_eq!(kilobytes("MemAvailable: x kB\n", "MemAvailable:"), None);
    }
}
