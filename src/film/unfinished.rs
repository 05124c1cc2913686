//! Files that have not got their final names yet, and the end of the program.

use super::atomic_file::{Overwrite, directory_of};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::TempPath;

/// The files that are being written to, by their temporary names. They are locked while one appears or gets its final name, so that whoever
/// ends the program can remove them all.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all files that are unfinished. The program is about to end: no other file can be begun or finished from now on, and whoever
/// tries waits for ever.
pub fn abandon() {
    let mut paths = unfinished();
    for path in paths.drain(..) {
        // One that cannot be removed is hidden, and not under the final name.
        let _ = fs::remove_file(path);
    }
    std::mem::forget(paths);
}

/// A file that has not got its final name yet. It is removed when it is dropped.
pub(super) struct Unfinished {
    path: Option<TempPath>,
}

impl Unfinished {
    /// A new file in the directory of `target`. It is opened as any file is, so that the umask decides who may read
    /// it: `tempfile` would by itself make it private. The name is short whatever the target's, because names have a
    /// greatest length.
    pub(super) fn beside(target: &Path) -> io::Result<(File, Unfinished)> {
        let create = |path: &Path| File::options().write(true).create_new(true).open(path);
        let mut unfinished = unfinished();
        let named = tempfile::Builder::new().prefix(".feimos-").suffix(".tmp").make_in(directory_of(target), create)?;
        let (file, path) = named.into_parts();
        unfinished.push(path.to_path_buf());
        Ok((file, Unfinished { path: Some(path) }))
    }

    pub(super) fn rename(mut self, target: &Path, overwrite: Overwrite) -> io::Result<()> {
        let mut unfinished = unfinished();
        let path = self.path.take().expect("nobody else takes it");
        forget(&mut unfinished, &path);
        let renamed = match overwrite {
            Overwrite::Yes => path.persist(target),
            Overwrite::No => path.persist_noclobber(target),
        };
        renamed.map_err(|refused| refused.error)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if let Some(path) = self.path.take() {
            let mut unfinished = unfinished();
            forget(&mut unfinished, &path);
            // Removed before the lock is let go, or a signal between would leave it.
            drop(path);
        }
    }
}

fn forget(unfinished: &mut Vec<PathBuf>, path: &Path) {
    unfinished.retain(|other| other != path);
}
