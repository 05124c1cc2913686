//! Folders for outputs: made if they are missing.

use crate::error::{Error, Result};
use crate::film::atomic_file::{self, Out, Overwrite, directory_of};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

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

    /// Makes the missing folders of the file `path`.
    pub(crate) fn make_for(path: &Path) -> Result<NewFolders> {
        match first_missing(path) {
            Some(_) => NewFolders::make(directory_of(path)),
            None => Ok(NewFolders(Vec::new())),
        }
    }

    /// Syncs the names of the folders to the disk, as far as the system can.
    fn sync(&self) {
        let open = |folder: &PathBuf| File::open(directory_of(folder));
        let opened = self.0.iter().filter_map(|folder| open(folder).ok());
        opened.for_each(|parent| _ = parent.sync_all());
    }
}

impl Drop for NewFolders {
    fn drop(&mut self) {
        // The system refuses to remove a folder that is not empty.
        self.0.iter().for_each(|folder| _ = fs::remove_dir(folder));
    }
}

/// The outermost missing folder of the file `path`; a link that leads nowhere is not missing.
fn first_missing(path: &Path) -> Option<&Path> {
    let folders = path.ancestors().skip(1);
    let missing =
        folders.take_while(|folder| **folder != *"" && folder.symlink_metadata().is_err());
    missing.last()
}

/// Checks that the file `path` can be written, with its missing folders.
///
/// # Errors
/// Like [`atomic_file::check`]; or the outermost missing folder cannot be made.
pub(crate) fn check_with_folders(path: &Path) -> Result<()> {
    // Who may make a file there may make a folder.
    atomic_file::check(first_missing(path).unwrap_or(path))
}

/// Writes the file `path` like [`atomic_file::write_file`], and makes its missing folders. They are
/// removed again if the file cannot be written.
pub(crate) fn write_with_folders(
    path: &Path,
    overwrite: Overwrite,
    write: impl FnOnce(&mut Out) -> io::Result<()>,
) -> Result<()> {
    let folders = NewFolders::make_for(path)?;
    atomic_file::write_file(path, overwrite, write)?;
    folders.sync();
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

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

    #[test]
    fn the_outermost_missing_folder_is_checked() {
        let directory = tempfile::tempdir().unwrap();
        let path = |name: &str| directory.path().join(name);
        fs::write(path("file"), "").unwrap();
        fs::create_dir(path("a")).unwrap();
        assert_eq!(first_missing(&path("a/b/c/d.exr")), Some(&*path("a/b")));
        assert_eq!(first_missing(&path("a/d.exr")), None);
        assert_eq!(first_missing(Path::new("d.exr")), None);
        assert!(check_with_folders(&path("a/b/c/d.exr")).is_ok());
        assert!(check_with_folders(&path("file/b/c/d.exr")).is_err());
        assert!(!path("a/b").exists(), "a check makes nothing");
    }

    #[test]
    fn folders_appear_with_their_file_only() {
        let directory = tempfile::tempdir().unwrap();
        let path = |name: &str| directory.path().join(name);
        let write = |name, content: io::Result<&[u8]>| {
            write_with_folders(&path(name), Overwrite::Yes, |out| out.write_all(content?))
        };
        let full = io::ErrorKind::StorageFull.into();
        assert!(write("a/b/c.exr", Err(full)).is_err() && !path("a").exists());
        write("a/b/c.exr", Ok(b"new")).unwrap();
        assert_eq!(fs::read(path("a/b/c.exr")).unwrap(), b"new");
    }
}
