//! Checks that a file can be created, before the work.

use super::target::{directory_of, names_directory, target};
use super::unfinished::Unfinished;
use crate::error::{Error, Result};
use std::fs::{self, File, Metadata};
use std::io;
use std::path::Path;

/// Reports errors that [`super::write_file`] would certainly make, before the work for it begins.
pub fn check(path: &Path) -> Result<()> {
    let target = target(path).map_err(|error| Error::creating(path, &error))?;
    match fs::metadata(&target) {
        Ok(found) if found.is_dir() => Err(is_directory(path)),
        Ok(found) if found.is_file() => check_replaceable(path, &target, &writable(path)?),
        Ok(_) => Ok(()),
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(Error::creating(path, &error)),
        Err(_) if names_directory(&target) => Err(is_directory(path)),
        Err(_) => match fs::metadata(directory_of(&target)) {
            Ok(directory) if directory.is_dir() => check_free(path, &target),
            Ok(_) => Err(Error::creating(path, &io::ErrorKind::NotADirectory.into())),
            Err(error) => Err(creating(path, &target, &error)),
        },
    }
}

pub(super) fn is_directory(path: &Path) -> Error {
    Error::creating(path, &io::ErrorKind::IsADirectory.into())
}

/// The metadata of the existing file `path`, if it is writable.
pub(super) fn writable(path: &Path) -> Result<Metadata> {
    File::options()
        .write(true)
        .open(path)
        .and_then(|file| file.metadata())
        .map_err(|error| Error::creating(path, &error))
}

/// The error of [`Unfinished::beside`], with advice if only the directory is missing.
pub(super) fn creating(path: &Path, target: &Path, error: &io::Error) -> Error {
    let directory = directory_of(target);
    let creating = Error::creating(path, error);
    if directory.exists() {
        return creating;
    }
    creating.note(format!(
        "create the directory `{}` first",
        directory.display()
    ))
}

/// Checks that the directory of `target`, the end of the links of `path`, accepts new files, by
/// making one.
fn check_free(path: &Path, target: &Path) -> Result<()> {
    Unfinished::beside(target)
        .map(drop)
        .map_err(|error| creating(path, target, &error))
}

/// Checks that the file `target`, the end of the links of `path`, can be replaced; `found` is its
/// metadata.
fn check_replaceable(path: &Path, target: &Path, found: &Metadata) -> Result<()> {
    check_free(path, target)?;
    if keeps_from_renaming(target, found) {
        let message = "the file and its folder belong to another user, and only owners may replace \
                       files in this folder";
        let error = io::Error::new(io::ErrorKind::PermissionDenied, message);
        return Err(Error::creating(path, &error));
    }
    Ok(())
}

/// Returns true if the directory is sticky, like `/tmp`, and the user owns neither it nor the file.
#[cfg(unix)]
fn keeps_from_renaming(target: &Path, found: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    const STICKY: u32 = 0o1000;
    let Ok(directory) = fs::metadata(directory_of(target)) else {
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
