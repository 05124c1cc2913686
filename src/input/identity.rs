//! Which file a path leads to.

use std::fs::Metadata;
use std::path::Path;

/// One for each file, as far as the system can tell.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct Identity(Key);

#[cfg(unix)]
type Key = (u64, u64);
#[cfg(not(unix))]
type Key = std::path::PathBuf;

impl Identity {
    /// That of the file `path`, and its size; `None` where it is not there.
    pub(super) fn of(path: &Path) -> Option<(Identity, u64)> {
        let metadata = std::fs::metadata(path).ok()?;
        Some((Identity(key(path, &metadata)), metadata.len()))
    }
}

#[cfg(unix)]
fn key(_: &Path, metadata: &Metadata) -> Key {
    use std::os::unix::fs::MetadataExt;
    (metadata.dev(), metadata.ino())
}

#[cfg(not(unix))]
fn key(path: &Path, _: &Metadata) -> Key {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}
