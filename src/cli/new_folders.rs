//! Folders that are made for what may never come.

use feimos::error::{Error, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder, and which of the folders on its path were made for it. Those that are still empty when
/// this is dropped vanish again.
#[derive(Debug)]
pub(crate) struct NewFolders(Vec<PathBuf>);

impl NewFolders {
    /// Makes `path` and what is missing above it.
    pub(crate) fn make(path: &Path) -> Result<NewFolders> {
        let is_missing = |folder: &&Path| **folder != *"" && !folder.exists();
        // The innermost first, which is how they can be removed.
        let made = NewFolders(
            path.ancestors()
                .take_while(is_missing)
                .map(Path::to_path_buf)
                .collect(),
        );
        fs::create_dir_all(path).map_err(|error| Error::creating(path, &error))?;
        Ok(made)
    }
}

impl Drop for NewFolders {
    fn drop(&mut self) {
        // The system refuses to remove what is not empty.
        self.0.iter().for_each(|folder| _ = fs::remove_dir(folder));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_empty_folders_that_were_made_vanish() {
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
