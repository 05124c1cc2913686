//! Symbolic links to files that need not exist.

use super::directory_of;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Symbolic links that are followed one after another; Linux gives up at the same number.
const MAX_LINKS: usize = 40;

/// Where `path` leads to, through symbolic links; the end need not exist.
///
/// # Errors A link that the system does not follow: Linux refuses those of other users in folders
/// such as `/tmp` (`fs.protected_symlinks`). Following it by hand would replace a file of the other
/// user's choice.
pub(super) fn follow_links(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_path_buf();
    for _ in 0..MAX_LINKS {
        match fs::symlink_metadata(&target) {
            Ok(found) if found.is_symlink() => {}
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => return Ok(target),
        }
        let next = fs::read_link(&target)?;
        // Asked after the link was read: a link that appeared only now is not followed unseen
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
