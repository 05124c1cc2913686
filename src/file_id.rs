//! The identity of files: device and inode, whatever the path.

use std::collections::HashMap;
use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

/// A regular file, whatever links, `..` and other spellings its path has.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct FileId(Inner);

#[cfg(unix)]
type Inner = [u64; 2];

#[cfg(not(unix))]
type Inner = PathBuf;

impl FileId {
    /// The file at `path`; `None` if it is not a regular file.
    pub fn of(path: &Path) -> Option<FileId> {
        FileId::with_size(path).map(|(id, _)| id)
    }

    /// Likewise, and the size of the file in bytes.
    pub(crate) fn with_size(path: &Path) -> Option<(FileId, u64)> {
        let metadata = fs::metadata(path).ok().filter(Metadata::is_file)?;
        Some((FileId::of_any(path, &metadata)?, metadata.len()))
    }

    /// The directory `path`; `None` if it is not one.
    pub fn of_directory(path: &Path) -> Option<FileId> {
        let metadata = fs::metadata(path).ok().filter(Metadata::is_dir)?;
        FileId::of_any(path, &metadata)
    }

    /// The file behind standard input; `None` for a pipe or a terminal.
    pub fn of_stdin() -> Option<FileId> {
        stdin()
            .ok()
            .filter(Metadata::is_file)
            .and_then(|metadata| FileId::of_any(Path::new("-"), &metadata))
    }

    #[cfg(unix)]
    fn of_any(_: &Path, metadata: &Metadata) -> Option<FileId> {
        use std::os::unix::fs::MetadataExt;
        Some(FileId([metadata.dev(), metadata.ino()]))
    }

    #[cfg(not(unix))]
    fn of_any(path: &Path, _: &Metadata) -> Option<FileId> {
        path.canonicalize().ok().map(FileId)
    }
}

#[cfg(unix)]
fn stdin() -> io::Result<Metadata> {
    use std::os::fd::AsFd;
    fs::File::from(io::stdin().as_fd().try_clone_to_owned()?).metadata()
}

#[cfg(not(unix))]
fn stdin() -> io::Result<Metadata> {
    Err(io::ErrorKind::Unsupported.into())
}

/// The files that were read for some purpose, each with the path that led to it.
#[derive(Debug, Clone, Default)]
pub struct InputFiles(HashMap<FileId, PathBuf>);

impl InputFiles {
    /// Adds the scene `path` if it is a regular file; `-` is standard input.
    pub fn add_named(&mut self, path: &Path) {
        let id = if path == Path::new("-") {
            FileId::of_stdin()
        } else {
            FileId::of(path)
        };
        self.note(id, path);
    }

    /// Adds the file `path` if it is a regular file.
    pub fn add(&mut self, path: &Path) {
        self.note(FileId::of(path), path);
    }

    fn note(&mut self, id: Option<FileId>, path: &Path) {
        id.into_iter()
            .for_each(|id| _ = self.0.entry(id).or_insert_with(|| path.to_path_buf()));
    }

    /// The path that led to the file `id`.
    pub fn path_of(&self, id: &FileId) -> Option<&Path> {
        self.0.get(id).map(PathBuf::as_path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_itself_by_every_name() {
        let directory = tempfile::tempdir().unwrap();
        let path = |name: &str| directory.path().join(name);
        fs::create_dir(path("sub")).unwrap();
        fs::write(path("a"), "").unwrap();
        fs::write(path("b"), "").unwrap();
        let id = FileId::of(&path("a"));
        assert!(
            id.is_some() && id == FileId::of(&path("sub/../a")) && id != FileId::of(&path("b"))
        );
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("a", path("soft")).unwrap();
            fs::hard_link(path("a"), path("hard")).unwrap();
            assert!(id == FileId::of(&path("soft")) && id == FileId::of(&path("hard")));
        }
        assert_eq!(
            (FileId::of(&path("gone")), FileId::of(&path("sub"))),
            (None, None)
        );
    }

    #[test]
    fn files_are_found_by_their_identity() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a");
        fs::write(&path, "").unwrap();
        let mut files = InputFiles::default();
        files.add(&path);
        files.add(&directory.path().join("gone"));
        assert_eq!(
            files.path_of(&FileId::of(&path).unwrap()),
            Some(path.as_path())
        );
        assert_eq!(files.0.len(), 1);
    }
}
