//! Writes a file to a temporary place and then gives it its name.

use super::check::{creating, is_directory, writable};
use super::permissions;
use super::target::{directory_of, target};
use super::unfinished::{Overwrite, Unfinished};
use super::write_behind::WriteBehind;
use crate::error::{Error, Result};
use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Seek, Write};
use std::path::Path;

/// The file that writers write to.
pub type Out = BufWriter<WriteBehind>;

/// Writes the content of a file. It is called once at most.
type WriteContent<'a> = dyn FnMut(&mut Out) -> io::Result<()> + 'a;

/// Size of the buffer: a compressed scan line has some thousand bytes.
pub(super) const BUFFER: usize = 1 << 16;

/// Creates the file `path` with the content that `write` writes; returns its size in bytes.
///
/// - Follows symbolic links: the link stays, and the file that it leads to is replaced. A link that
///   the system forbids to follow is an error.
/// - Gives a new file the owner and permissions of any new file. A replaced file keeps both, or
///   neither if the user must not give files to its owner. A file that is not writable is not
///   replaced.
/// - Writes to anything but regular files (`/dev/null`, a pipe) in place, whatever `overwrite` says.
/// - Changes only this name of a file with several names (hard links).
pub fn write_file(
    path: &Path,
    overwrite: Overwrite,
    write: impl FnOnce(&mut Out) -> io::Result<()>,
) -> Result<u64> {
    let mut write = Some(write);
    create(path, overwrite, &mut |out| match write.take() {
        Some(write) => write(out),
        None => unreachable!("called once"),
    })
}

fn create(path: &Path, overwrite: Overwrite, write: &mut WriteContent) -> Result<u64> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(is_directory(path)),
        Ok(found) if !found.is_file() => write_through(path, write),
        Ok(_) if overwrite == Overwrite::No => Err(exists(path)),
        Ok(_) => replace(path, overwrite, Some(writable(path)?), write),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            replace(path, overwrite, None, write)
        }
        // After any other error, there may be a file, which must not be replaced unseen.
        Err(error) => Err(Error::creating(path, &error)),
    }
}

fn exists(path: &Path) -> Error {
    let error = io::Error::new(io::ErrorKind::AlreadyExists, "the file exists");
    Error::creating(path, &error)
}

fn replace(
    path: &Path,
    overwrite: Overwrite,
    replaced: Option<Metadata>,
    write: &mut WriteContent,
) -> Result<u64> {
    let target = target(path).map_err(|error| Error::creating(path, &error))?;
    let (file, unfinished) =
        Unfinished::beside(&target).map_err(|error| creating(path, &target, &error))?;
    // From here on, dropping `unfinished` removes the file, after an error or a panic.
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

/// The error of an incomplete file, with advice if a limit is the reason.
fn writing(path: &Path, error: &io::Error) -> Error {
    let writing = Error::writing(path, error);
    match error.kind() {
        io::ErrorKind::FileTooLarge => {
            writing.note("raise the limit on the size of files (`ulimit -f`)")
        }
        _ => writing,
    }
}

/// Writes the content and syncs it to the disk.
fn fill(file: File, replaced: Option<Metadata>, write: &mut WriteContent) -> io::Result<File> {
    let mut out = BufWriter::with_capacity(BUFFER, WriteBehind::new(file));
    write(&mut out)?;
    let file = out.into_inner()?.into_file();
    if let Some(replaced) = replaced {
        permissions::keep(&file, &replaced);
    }
    // Network file systems report a full disk only here. And after a power cut, the disk may have
    // the rename without the content: without this call, a short file could have the final name.
    file.sync_data()?;
    Ok(file)
}

/// Syncs the name of the file `path` to the disk. Without this, a power cut may undo the creation
/// or replacement of the file, although its content is on the disk.
///
/// A folder that cannot be opened, or a file system that cannot sync one, is no error: nothing more
/// can be done.
pub fn sync_folder(path: &Path) -> Result<()> {
    use io::ErrorKind::{InvalidInput, PermissionDenied, Unsupported};
    // Windows cannot open folders, and its file systems sync names by themselves.
    if cfg!(not(unix)) || !path.is_file() {
        return Ok(());
    }
    let synced = target(path).and_then(|target| File::open(directory_of(&target))?.sync_all());
    match synced {
        Err(error) if !matches!(error.kind(), InvalidInput | PermissionDenied | Unsupported) => {
            Err(Error::writing(path, &error))
        }
        _ => Ok(()),
    }
}

/// Writes to a device or a pipe. Formats need to seek, and a pipe cannot, so the content is first
/// written to an unnamed file.
fn write_through(path: &Path, write: &mut WriteContent) -> Result<u64> {
    let mut device = File::options()
        .write(true)
        .open(path)
        .map_err(|error| Error::creating(path, &error))?;
    let mut copy = || {
        let copy = WriteBehind::unsynced(tempfile::tempfile()?);
        let mut out = BufWriter::with_capacity(BUFFER, copy);
        write(&mut out)?;
        let mut file = out.into_inner()?.into_file();
        file.rewind()?;
        let size = io::copy(&mut file, &mut device)?;
        device.flush()?;
        Ok(size)
    };
    copy().map_err(|error| Error::writing(path, &error))
}
