//! Checks before the work that a file can be created.

use super::atomic_file::{creating, directory_of};
use super::unfinished::Unfinished;
use crate::error::{Error, Result};
use std::fs::Metadata;
use std::path::Path;

/// Returns true for names of directories, such as `a.exr/` and `a.exr/.`.
pub(super) fn names_directory(target: &Path) -> bool {
    let name = target.as_os_str().as_encoded_bytes();
    let is_separator = |byte: u8| std::path::is_separator(char::from(byte));
    let name = name
        .strip_suffix(b".")
        .filter(|rest| rest.last().is_some_and(|byte| is_separator(*byte)))
        .unwrap_or(name);
    name.last().is_some_and(|byte| is_separator(*byte))
}

/// Checks that the directory of `target`, where `path` leads to, takes new files, by making one.
pub(super) fn check_free(path: &Path, target: &Path) -> Result<()> {
    Unfinished::beside(target)
        .map(drop)
        .map_err(|error| creating(path, target, &error))
}

/// Checks that the file `target`, which `path` leads to and `found` is of, can be replaced.
pub(super) fn check_replaceable(path: &Path, target: &Path, found: &Metadata) -> Result<()> {
    check_free(path, target)?;
    if keeps_from_renaming(target, found) {
        let message = "the file belongs to another user, and so does its folder, in which only owners replace files";
        let error = std::io::Error::new(std::io::ErrorKind::PermissionDenied, message);
        return Err(Error::creating(path, &error));
    }
    Ok(())
}

/// Returns true if the directory is sticky, as `/tmp` is, and the user owns neither it nor the
/// file.
#[cfg(unix)]
fn keeps_from_renaming(target: &Path, found: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    const STICKY: u32 = 0o1000;
    let Ok(directory) = std::fs::metadata(directory_of(target)) else {
        return false;
    };
    let user = rustix::process::geteuid();
    let owners = [found.uid(), directory.uid()];
    directory.mode() & STICKY != 0 && !user.is_root() && !owners.contains(&user.as_raw())
}

#[cfg(not(unix))]
fn keeps_from_renaming(_: &Path, _: &Metadata) -> bool {
    false
}
