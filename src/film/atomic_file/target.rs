//! The target of a path: the end of its symbolic links, and its directory.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A limit on links followed one after another, the same as in Linux.
const MAX_LINKS: usize = 40;

/// The path that [`super::write_file`] writes to: the end of the symbolic links of `path`, which
/// need not exist.
///
/// # Errors
/// The system refuses a link: Linux refuses those of other users in folders such as `/tmp`
/// (`fs.protected_symlinks`). Following it by hand would replace a file of the other user's choice.
pub fn target(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_path_buf();
    for _ in 0..MAX_LINKS {
        match fs::symlink_metadata(&target) {
            Ok(found) if found.is_symlink() => {}
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => return Ok(target),
        }
        let next = fs::read_link(&target)?;
        // After reading the link, so that a link that has just appeared is not followed unchecked
        // either.
        if let Err(error) = fs::metadata(&target)
            && error.kind() != io::ErrorKind::NotFound
        {
            return Err(error);
        }
        target = directory_of(&target).join(next);
    }
    Err(io::Error::other("too many levels of symbolic links"))
}

/// The directory of `path`; `.` if it names none.
pub fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

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
