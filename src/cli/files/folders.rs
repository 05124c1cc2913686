//! Folders for outputs: made if they are missing, and tried once.

use super::destination::Destination;
use feimos::error::{Error, Result};
use feimos::film::atomic_file::directory_of;
use std::collections::HashSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Folders that were made for outputs. Dropping it removes those that are still empty.
#[derive(Debug)]
pub(crate) struct NewFolders(Vec<PathBuf>);

impl NewFolders {
    /// Makes `path` and its missing parents.
    pub(crate) fn make(path: &Path) -> Result<NewFolders> {
        let is_missing = |folder: &&Path| **folder != *"" && !folder.exists();
        // Innermost first: the order in which they can be removed.
        let missing = path.ancestors().take_while(is_missing);
        let made = NewFolders(missing.map(Path::to_path_buf).collect());
        fs::create_dir_all(path).map_err(|error| Error::creating(path, &error))?;
        Ok(made)
    }
}

impl Drop for NewFolders {
    fn drop(&mut self) {
        // The system refuses to remove a folder that is not empty.
        self.0.iter().for_each(|folder| _ = fs::remove_dir(folder));
    }
}

/// Folders that accept new files. A trial makes a file, so it is not repeated for each image.
#[derive(Debug, Default)]
pub(crate) struct OpenFolders(Mutex<HashSet<PathBuf>>);

impl OpenFolders {
    /// # Errors
    /// Like [`Destination::check`].
    pub(crate) fn check(&self, destination: &Destination) -> Result<()> {
        let Destination::File(path) = destination else {
            return destination.check();
        };
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // An existing file may be a link to another folder, or protected.
        let found = path.symlink_metadata();
        let is_free = found.is_err_and(|error| error.kind() == io::ErrorKind::NotFound);
        let last = path.as_os_str().as_encoded_bytes().last();
        let names_file = last.is_some_and(u8::is_ascii_alphanumeric);
        if is_free && names_file && known.contains(directory_of(path)) {
            return Ok(());
        }
        destination.check()?;
        if is_free {
            known.insert(directory_of(path).to_path_buf());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_new_and_empty_folders_are_removed() {
        let directory = tempfile::tempdir().unwrap();
        let path = |name: &str| directory.path().join(name);
        drop(NewFolders::make(&path("a/b/c")).unwrap());
        assert!(!path("a").exists());
        fs::create_dir(path("a")).unwrap();
        drop(NewFolders::make(&path("a/b/c")).unwrap());
        assert!(path("a").exists() && !path("a/b").exists());
        let made = NewFolders::make(&path("a/b/c")).unwrap();
        fs::write(path("a/b/file"), "").unwrap();
        drop(made);
        assert!(path("a/b/file").exists() && !path("a/b/c").exists());
    }
}
