//! Where an output goes, told apart from where others go.

use super::output_name::Destination;
use feimos::file_id::FileId;
use feimos::film::atomic_file::{self, directory_of};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// One place, however its name is spelled: links, `..` and the like make no difference.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) enum Place {
    Stdout,
    /// A file that is there.
    File(FileId),
    /// A name in a directory that is there.
    Free(FileId, OsString),
    /// A name that cannot be looked up.
    Unknown(PathBuf),
}

impl Place {
    pub(crate) fn of(destination: &Destination) -> Place {
        match destination {
            Destination::Stdout => Place::Stdout,
            Destination::File(path) => Place::of_file(path),
        }
    }

    pub(crate) fn of_file(path: &Path) -> Place {
        if let Some(id) = FileId::of(path) {
            return Place::File(id);
        }
        let target = atomic_file::target(path).unwrap_or_else(|_| path.to_path_buf());
        match (FileId::of_directory(directory_of(&target)), target.file_name()) {
            (Some(directory), Some(name)) => Place::Free(directory, name.to_owned()),
            _ => Place::Unknown(target),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn spellings_of_one_place_are_equal() {
        let directory = tempfile::tempdir().unwrap();
        let place = |name: &str| Place::of_file(&directory.path().join(name));
        fs::create_dir(directory.path().join("sub")).unwrap();
        assert_eq!(place("a.exr"), place("sub/../a.exr"));
        assert_ne!(place("a.exr"), place("b.exr"));
        assert_ne!(place("a.exr"), place("sub/a.exr"));
        fs::write(directory.path().join("a.exr"), "").unwrap();
        assert_eq!(place("a.exr"), place("./a.exr"));
    }

    #[cfg(unix)]
    #[test]
    fn links_lead_to_the_place_they_lead_to() {
        use std::os::unix::fs::symlink;
        let directory = tempfile::tempdir().unwrap();
        let path = |name: &str| directory.path().join(name);
        let place = |name: &str| Place::of_file(&path(name));
        fs::create_dir(path("sub")).unwrap();
        symlink("sub", path("link")).unwrap();
        symlink("sub/a.exr", path("b.exr")).unwrap();
        assert_eq!(place("link/a.exr"), place("sub/a.exr"));
        assert_eq!(place("b.exr"), place("sub/a.exr"), "nothing is there yet");
        fs::write(path("sub/a.exr"), "").unwrap();
        fs::hard_link(path("sub/a.exr"), path("c.exr")).unwrap();
        assert_eq!(place("b.exr"), place("c.exr"));
    }
}
