//! Files with temporary names, and the locks that show that their writers live.
//!
//! A name is `.feimos-HOST-RANDOM.tmp`. The writer holds an exclusive `flock` on the file until it
//! closes it, and the system drops the lock of a dead process. `HOST` says which machine can tell:
//! some network file systems keep locks to themselves. Without locks there is no `HOST`.

use super::target::directory_of;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;
use std::sync::OnceLock;
use tempfile::{NamedTempFile, TempPath};

const PREFIX: &str = ".feimos-";
const SUFFIX: &str = ".tmp";

/// Makes a file with a temporary name beside `target`.
///
/// It is opened like any file, so that the umask decides who may read it: `tempfile` would make it
/// private.
pub(super) fn create(target: &Path) -> io::Result<(File, TempPath)> {
    let new = |path: &Path| File::options().write(true).create_new(true).open(path);
    let mut tries = 0;
    let locked = |path: &Path| {
        let file = new(path)?;
        tries += 1;
        lock(&file, path, tries).inspect_err(|_| _ = fs::remove_file(path))?;
        Ok(file)
    };
    let made = match host() {
        Some(host) => named(target, host, locked),
        None => Err(io::ErrorKind::Unsupported.into()),
    };
    let made = match made {
        Err(error) if error.kind() == io::ErrorKind::Unsupported => named(target, "", new),
        made => made,
    };
    made.map(NamedTempFile::into_parts)
}

/// Locks the new `file`, which the name `path` was given to.
///
/// # Errors
/// `AlreadyExists`, which makes `tempfile` try again, if another process took the file for a
/// leftover before it was locked; `Unsupported` if there are no locks, or after too many tries.
fn lock(file: &File, path: &Path, tries: u32) -> io::Result<()> {
    const MAX_TRIES: u32 = 8;
    match file.try_lock() {
        Ok(()) if is_named(file, path)? => Ok(()),
        Ok(()) | Err(TryLockError::WouldBlock) if tries < MAX_TRIES => {
            Err(io::ErrorKind::AlreadyExists.into())
        }
        _ => Err(io::ErrorKind::Unsupported.into()),
    }
}

/// Gives `file`, which has no name, a temporary one beside `target` by `link`.
pub(super) fn link(
    file: &File,
    target: &Path,
    link: impl FnMut(&Path) -> io::Result<()>,
) -> io::Result<TempPath> {
    let host = host().filter(|_| file.try_lock().is_ok());
    named(target, host.unwrap_or_default(), link).map(NamedTempFile::into_temp_path)
}

/// Returns true for temporary names.
#[cfg(unix)]
pub(super) fn is_temporary(name: &str) -> bool {
    name.starts_with(PREFIX) && name.ends_with(SUFFIX)
}

/// Returns true for the names of files that writers on this machine have locked.
#[cfg(unix)]
pub(super) fn is_of_this_host(name: &str) -> bool {
    let of = |host: &str| {
        name.strip_prefix(PREFIX)?
            .strip_prefix(host)?
            .strip_prefix('-')
    };
    host().and_then(of).is_some()
}

/// Returns true if `path` is a name of `file`, and not that of another file, or of none.
#[cfg(unix)]
pub(super) fn is_named(file: &File, path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt;
    let id = |found: fs::Metadata| (found.dev(), found.ino());
    match fs::symlink_metadata(path) {
        Ok(named) => Ok(id(file.metadata()?) == id(named)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}

/// Elsewhere no program removes the files of others.
#[cfg(not(unix))]
fn is_named(_: &File, _: &Path) -> io::Result<bool> {
    Ok(true)
}

/// Makes a file by `create`. The name is short whatever the target, because names have a maximal
/// length.
fn named<F>(
    target: &Path,
    host: &str,
    create: impl FnMut(&Path) -> io::Result<F>,
) -> io::Result<NamedTempFile<F>> {
    let separator = if host.is_empty() { "" } else { "-" };
    tempfile::Builder::new()
        .prefix(&format!("{PREFIX}{host}{separator}"))
        .suffix(SUFFIX)
        .make_in(directory_of(target), create)
}

/// A number of this machine since it was started, which all its containers share; `None` if the
/// system has no such number.
fn host() -> Option<&'static str> {
    /// Enough for the machines of a farm to differ.
    const DIGITS: usize = 12;
    static HOST: OnceLock<Option<String>> = OnceLock::new();
    let read = || {
        let boot = fs::read_to_string("/proc/sys/kernel/random/boot_id").ok()?;
        let digits: String = boot.chars().filter(char::is_ascii_hexdigit).collect();
        digits.get(..DIGITS).map(str::to_owned)
    };
    HOST.get_or_init(read).as_deref()
}
