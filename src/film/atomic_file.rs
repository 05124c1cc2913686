//! Files that appear whole or not at all.
//!
//! The bytes go to a new file in the directory of the final name, which is then renamed onto it. Whoever looks
//! at the final name sees the old file or the new one, and an error leaves the old one untouched.

use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::TempPath;

use crate::error::{Error, Result};

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

/// Symbolic links that are followed one after another; Linux gives up at the same number.
const MAX_LINKS: usize = 40;

/// Creates the file `path` with what `write` writes; returns its size in bytes.
///
/// - A symbolic link is followed: it stays, and the file it leads to is replaced, as it would be without the
///   detour by a rename.
/// - A new file gets the permissions of any new file, a replaced one keeps its own. One that may not be written
///   to is not replaced either, although a rename could.
/// - What is not a regular file (`/dev/null`, a pipe) is written to, whatever `overwrite` says: it must stay.
/// - Of a file that has several names (hard links) only this one gets the new content.
pub fn write_file(path: &Path, overwrite: Overwrite, write: impl FnOnce(&mut Out) -> io::Result<()>) -> Result<u64> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(Error::creating(path, &io::ErrorKind::IsADirectory.into())),
        Ok(found) if !found.is_file() => write_through(path, write),
        Ok(_) if overwrite == Overwrite::No => Err(exists(path)),
        Ok(_) => replace(path, overwrite, Some(writable(path)?), write),
        // Also where the reason is another one, such as a file in the place of a directory: creation will tell.
        Err(_) => replace(path, overwrite, None, write),
    }
}

fn exists(path: &Path) -> Error {
    Error::creating(path, &io::Error::new(io::ErrorKind::AlreadyExists, "the file exists"))
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
    let (file, temporary) = create_beside(&target).map_err(|error| creating(path, &target, &error))?;
    // From here on, dropping `temporary` removes the file, by an error or a panic.
    let size = fill(file, replaced, write).map_err(|error| Error::writing(path, &error))?;
    rename(temporary, &target, overwrite).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => exists(path),
        _ => Error::writing(path, &error),
    })?;
    Ok(size)
}

/// Where `path` leads to, through symbolic links; the end need not exist.
fn follow_links(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_path_buf();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&target) {
            Ok(next) => target = directory_of(&target).join(next),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("too many levels of symbolic links"))
}

fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// A new file in the directory of `target`. It is opened as any file is, so that the umask decides who may read
/// it: `tempfile` would by itself make it private. The name is short whatever the target's, because names have a
/// greatest length.
fn create_beside(target: &Path) -> io::Result<(File, TempPath)> {
    let create = |path: &Path| File::options().write(true).create_new(true).open(path);
    let named = tempfile::Builder::new().prefix(".feimos-").suffix(".tmp").make_in(directory_of(target), create)?;
    Ok(named.into_parts())
}

/// The error of [`create_beside`], with advice where only the directory is missing.
fn creating(path: &Path, target: &Path, error: &io::Error) -> Error {
    let directory = directory_of(target);
    let creating = Error::creating(path, error);
    if directory.exists() {
        return creating;
    }
    creating.note(format!("create the directory `{}` first", directory.display()))
}

/// Writes the content and returns its size.
fn fill(file: File, replaced: Option<Metadata>, write: impl FnOnce(&mut Out) -> io::Result<()>) -> io::Result<u64> {
    let mut out = BufWriter::with_capacity(BUFFER, file);
    write(&mut out)?;
    let file = out.into_inner()?;
    if let Some(replaced) = replaced {
        // A file system that knows no permissions is no reason to fail.
        let _ = file.set_permissions(replaced.permissions());
    }
    // Network file systems tell of a full disk only now, and after a power cut the rename alone may have
    // reached the disk: without this, a short file could stand under the final name after all.
    file.sync_all()?;
    Ok(file.metadata()?.len())
}

fn rename(temporary: TempPath, target: &Path, overwrite: Overwrite) -> io::Result<()> {
    let renamed = match overwrite {
        Overwrite::Yes => temporary.persist(target),
        Overwrite::No => temporary.persist_noclobber(target),
    };
    renamed.map_err(|refused| refused.error)
}

/// Writes to a device or a pipe. Formats seek, and a pipe cannot, so the content is made in an unnamed file.
fn write_through(path: &Path, write: impl FnOnce(&mut Out) -> io::Result<()>) -> Result<u64> {
    let mut device = File::options().write(true).open(path).map_err(|error| Error::creating(path, &error))?;
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
