//! Unfinished files: those without their final name, and their removal at the end of the program.

use super::target::directory_of;
use super::{permissions, temporary_file, unnamed_file};
use std::fs::{self, File};
use std::io::{self, Seek};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::{Duration, Instant};
use tempfile::TempPath;

/// What to do with an existing file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Overwrite {
    /// Replace it.
    Yes,
    /// Fail, also if the file appears during the write.
    No,
}

/// The temporary names of unfinished files. The list is locked while a name appears or changes, so
/// that the end of the program can remove all of them.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// How long the end of the program waits for a file system that does not respond.
const PATIENCE: Duration = Duration::from_secs(1);

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all unfinished files. The program is about to end: no other file can be begun or
/// finished from now on, and a thread that tries waits for ever.
pub fn abandon() {
    let start = Instant::now();
    let mut paths = loop {
        match UNFINISHED.try_lock() {
            Ok(paths) => break paths,
            Err(TryLockError::Poisoned(poisoned)) => break poisoned.into_inner(),
            Err(TryLockError::WouldBlock) if start.elapsed() > PATIENCE => return,
            Err(TryLockError::WouldBlock) => std::thread::sleep(Duration::from_millis(1)),
        }
    };
    for path in paths.drain(..) {
        // A file that cannot be removed is hidden and does not have the final name.
        let _ = fs::remove_file(path);
    }
    std::mem::forget(paths);
}

/// A file without its final name. Dropping it removes the file.
///
/// If the system allows it, the file has no name at all until it is finished: then nothing is left
/// of it however the program ends. Otherwise it has a temporary name.
pub(super) struct Unfinished {
    /// The temporary name.
    path: Option<TempPath>,
}

impl Unfinished {
    /// Makes a file in the directory of `target`. If it is the first one there, removes what dead
    /// processes have left.
    pub(super) fn beside(target: &Path) -> io::Result<(File, Unfinished)> {
        let (file, unfinished) = match unnamed_file::create(directory_of(target)) {
            Some(file) => (file, Unfinished { path: None }),
            // If the file system does not only lack unnamed files, this reports the reason.
            None => Unfinished::named(target)?,
        };
        #[cfg(unix)]
        super::leftovers::remove(directory_of(target), &file);
        Ok((file, unfinished))
    }

    /// Makes a file with a temporary name.
    pub(super) fn named(target: &Path) -> io::Result<(File, Unfinished)> {
        let mut unfinished = unfinished();
        let (file, path) = temporary_file::create(target)?;
        unfinished.push(path.to_path_buf());
        Ok((file, Unfinished { path: Some(path) }))
    }

    /// Gives the complete `file` its final name.
    pub(super) fn finish(
        mut self,
        file: &mut File,
        target: &Path,
        overwrite: Overwrite,
    ) -> io::Result<()> {
        let Some(path) = self.path.take() else {
            return finish_unnamed(file, target, overwrite);
        };
        let mut unfinished = unfinished();
        forget(&mut unfinished, &path);
        rename(path, target, overwrite)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if let Some(path) = self.path.take() {
            let mut unfinished = unfinished();
            forget(&mut unfinished, &path);
            // Removed before the lock is released; a signal in between would leave it.
            drop(path);
        }
    }
}

fn forget(unfinished: &mut Vec<PathBuf>, path: &Path) {
    unfinished.retain(|other| other != path);
}

fn rename(path: TempPath, target: &Path, overwrite: Overwrite) -> io::Result<()> {
    let renamed = match overwrite {
        Overwrite::Yes => path.persist(target),
        Overwrite::No => path.persist_noclobber(target),
    };
    renamed.map_err(|refused| refused.error)
}

/// Gives a file its first name. A link cannot replace a file: then the file gets a temporary name
/// for an instant.
fn finish_unnamed(file: &mut File, target: &Path, overwrite: Overwrite) -> io::Result<()> {
    match link_or_replace(file, target, overwrite) {
        // The file system has unnamed files, but cannot give them names.
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => {
            finish_copy(file, target, overwrite)
        }
        result => result,
    }
}

fn link_or_replace(file: &File, target: &Path, overwrite: Overwrite) -> io::Result<()> {
    // The end of the program waits until the temporary name has gone.
    let _unfinished = unfinished();
    match unnamed_file::link(file, target) {
        Err(error)
            if error.kind() == io::ErrorKind::AlreadyExists && overwrite == Overwrite::Yes =>
        {
            let link = |path: &Path| unnamed_file::link(file, path);
            let path = temporary_file::link(file, target, link)?;
            rename(path, target, overwrite)
        }
        result => result,
    }
}

/// Finishes a file that has a temporary name.
fn finish_copy(file: &mut File, target: &Path, overwrite: Overwrite) -> io::Result<()> {
    let (mut copy, unfinished) = Unfinished::named(target)?;
    file.rewind()?;
    io::copy(file, &mut copy)?;
    permissions::keep(&copy, &file.metadata()?);
    copy.sync_data()?;
    unfinished.finish(&mut copy, target, overwrite)
}

#[cfg(test)]
mod tests {
    use super::super::tests::names_in;
    use super::*;
    use std::io::Write;

    type Finish = fn(&mut File, &Path, Overwrite) -> io::Result<()>;

    /// All ways to a final name replace what they may, keep what they must, and leave no other
    /// name.
    #[test]
    fn all_ways_to_a_final_name_agree() {
        let ways: [Finish; 2] = [finish_unnamed, finish_copy];
        for finish in ways {
            let directory = tempfile::tempdir().unwrap();
            let target = directory.path().join("a.exr");
            let finished = |text: &str, overwrite| {
                let mut file = tempfile::tempfile_in(directory.path()).unwrap();
                file.write_all(text.as_bytes()).unwrap();
                finish(&mut file, &target, overwrite)
            };
            finished("first", Overwrite::No).unwrap();
            let error = finished("second", Overwrite::No).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::AlreadyExists);
            assert_eq!(fs::read_to_string(&target).unwrap(), "first");
            finished("third", Overwrite::Yes).unwrap();
            assert_eq!(fs::read_to_string(&target).unwrap(), "third");
            assert_eq!(names_in(directory.path()), ["a.exr"]);
        }
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn an_unfinished_file_has_no_name() {
        let directory = tempfile::tempdir().unwrap();
        let target = directory.path().join("a.exr");
        let (mut file, unfinished) = Unfinished::beside(&target).unwrap();
        if unfinished.path.is_none() {
            assert!(names_in(directory.path()).is_empty());
        }
        file.write_all(b"abc").unwrap();
        unfinished
            .finish(&mut file, &target, Overwrite::No)
            .unwrap();
        assert_eq!(names_in(directory.path()), ["a.exr"]);
    }

    #[test]
    fn a_dropped_file_with_a_temporary_name_is_removed() {
        let directory = tempfile::tempdir().unwrap();
        let (_file, unfinished) = Unfinished::named(&directory.path().join("a.exr")).unwrap();
        assert!(names_in(directory.path())[0].starts_with(".feimos-"));
        drop(unfinished);
        assert!(names_in(directory.path()).is_empty());
    }
}
