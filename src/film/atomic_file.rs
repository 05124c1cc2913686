//! Files that appear whole or not at all.
//!
//! The bytes go to a new file in the directory of the final name, which gets that name when it is
//! complete. A reader of the final name sees the old file or the new one, and an error leaves the
//! old one untouched.

mod links;
#[cfg(test)]
mod tests;

use super::permissions;
use super::place;
use super::unfinished::Unfinished;
use crate::error::{Error, Result};
use links::follow_links;
use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

pub use super::unfinished::abandon;

/// Whether a file that exists may be replaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Overwrite {
    /// It is replaced.
    Yes,
    /// It is an error, also where the file appears while the new one is being written.
    No,
}

/// What writers write to.
pub type Out = BufWriter<File>;

/// Bytes that are collected before the system is called: a compressed scan line has some thousand.
const BUFFER: usize = 1 << 16;

/// Creates the file `path` with what `write` writes; returns its size in bytes.
///
/// - A symbolic link is followed: it stays, and the file it leads to is replaced, as it would be
///   without the detour by a rename. A link that the system forbids to follow is an error.
/// - A new file gets the owner and the permissions of any new file. A replaced file keeps both, or
///   neither where the user may not give files to its owner. A file that may not be written to is
///   not replaced.
/// - What is not a regular file (`/dev/null`, a pipe) is written to, whatever `overwrite` says: it must stay.
/// - Of a file that has several names (hard links) only this one gets the new content.
pub fn write_file(
    path: &Path,
    overwrite: Overwrite,
    write: impl FnOnce(&mut Out) -> io::Result<()>,
) -> Result<u64> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(is_directory(path)),
        Ok(found) if !found.is_file() => write_through(path, write),
        Ok(_) if overwrite == Overwrite::No => Err(exists(path)),
        Ok(_) => replace(path, overwrite, Some(writable(path)?), write),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            replace(path, overwrite, None, write)
        }
        // Any other error says that there may well be a file, which must not be replaced unseen.
        Err(error) => Err(Error::creating(path, &error)),
    }
}

/// Tells of errors that [`write_file`] would make for certain, so that nobody waits for an image that has no place.
pub fn check(path: &Path) -> Result<()> {
    let target = follow_links(path).map_err(|error| Error::creating(path, &error))?;
    match fs::metadata(&target) {
        Ok(found) if found.is_dir() => Err(is_directory(path)),
        Ok(found) if found.is_file() => place::check_replaceable(path, &target, &writable(path)?),
        Ok(_) => Ok(()),
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(Error::creating(path, &error)),
        Err(_) if place::names_directory(&target) => Err(is_directory(path)),
        Err(_) => match fs::metadata(directory_of(&target)) {
            Ok(directory) if directory.is_dir() => place::check_free(path, &target),
            Ok(_) => Err(Error::creating(path, &io::ErrorKind::NotADirectory.into())),
            Err(error) => Err(creating(path, &target, &error)),
        },
    }
}

/// Where [`write_file`] would put the file `path`: at the end of symbolic links.
///
/// # Errors
/// Links that cannot be followed.
pub fn target(path: &Path) -> io::Result<PathBuf> {
    follow_links(path)
}

fn is_directory(path: &Path) -> Error {
    Error::creating(path, &io::ErrorKind::IsADirectory.into())
}

fn exists(path: &Path) -> Error {
    Error::creating(
        path,
        &io::Error::new(io::ErrorKind::AlreadyExists, "the file exists"),
    )
}

/// The metadata of the existing file `path`, if it may be written to.
fn writable(path: &Path) -> Result<Metadata> {
    File::options()
        .write(true)
        .open(path)
        .and_then(|file| file.metadata())
        .map_err(|error| Error::creating(path, &error))
}

fn replace(
    path: &Path,
    overwrite: Overwrite,
    replaced: Option<Metadata>,
    write: impl FnOnce(&mut Out) -> io::Result<()>,
) -> Result<u64> {
    let target = follow_links(path).map_err(|error| Error::creating(path, &error))?;
    let (file, unfinished) =
        Unfinished::beside(&target).map_err(|error| creating(path, &target, &error))?;
    // From here on, dropping `unfinished` removes the file, by an error or a panic.
    let mut file = fill(file, replaced, write).map_err(|error| writing(path, &error))?;
    let size = file
        .metadata()
        .map_err(|error| writing(path, &error))?
        .len();
    unfinished
        .finish(&mut file, &target, overwrite)
        .map_err(|error| match error.kind() {
            io::ErrorKind::AlreadyExists => exists(path),
            _ => writing(path, &error),
        })?;
    Ok(size)
}

/// The error of a file that cannot be completed, with advice where a limit is the reason.
fn writing(path: &Path, error: &io::Error) -> Error {
    let writing = Error::writing(path, error);
    match error.kind() {
        io::ErrorKind::FileTooLarge => {
            writing.note("raise the limit on the size of files (`ulimit -f`)")
        }
        _ => writing,
    }
}

/// The directory that `path` is in, `.` where it names none.
pub fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// The error of [`Unfinished::beside`], with advice where only the directory is missing.
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

/// Writes the content and brings it to the disk.
fn fill(
    file: File,
    replaced: Option<Metadata>,
    write: impl FnOnce(&mut Out) -> io::Result<()>,
) -> io::Result<File> {
    let mut out = BufWriter::with_capacity(BUFFER, file);
    write(&mut out)?;
    let file = out.into_inner()?;
    if let Some(replaced) = replaced {
        permissions::keep(&file, &replaced);
    }
    // Network file systems tell of a full disk only now, and after a power cut the rename alone may have
    // reached the disk: without this, a short file could stand under the final name after all.
    file.sync_data()?;
    Ok(file)
}

/// Brings the name of the file `path` to the disk: without this, a power cut may take back that the
/// file was created or replaced, although its content is on the disk.
///
/// A folder that cannot be opened, or a file system that cannot sync one, is no error: nothing more
/// can be done.
pub fn sync_folder(path: &Path) -> Result<()> {
    use io::ErrorKind::{InvalidInput, PermissionDenied, Unsupported};
    // Windows opens no folders, and its file systems keep names by themselves.
    if cfg!(not(unix)) || !path.is_file() {
        return Ok(());
    }
    let synced =
        follow_links(path).and_then(|target| File::open(directory_of(&target))?.sync_all());
    match synced {
        Err(error) if !matches!(error.kind(), InvalidInput | PermissionDenied | Unsupported) => {
            Err(Error::writing(path, &error))
        }
        _ => Ok(()),
    }
}

/// Writes to a device or a pipe. Formats seek, and a pipe cannot, so the content is made in an unnamed file.
fn write_through(path: &Path, write: impl FnOnce(&mut Out) -> io::Result<()>) -> Result<u64> {
    let mut device = File::options()
        .write(true)
        .open(path)
        .map_err(|error| Error::creating(path, &error))?;
    let copy = || {
        let mut out = BufWriter::with_capacity(BUFFER, tempfile::tempfile()?);
        write(&mut out)?;
        let mut file = out.into_inner()?;
        file.rewind()?;
        let size = io::copy(&mut file, &mut device)?;
        device.flush()?;
        Ok(size)
    };
    copy().map_err(|error| Error::writing(path, &error))
}
