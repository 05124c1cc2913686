//! Unnamed files of Linux (`O_TMPFILE`): the system removes them with the program that made them.

#[cfg(target_os = "linux")]
pub(super) use linux::{create, link};

#[cfg(target_os = "linux")]
mod linux {
    use rustix::fs::{AtFlags, CWD, Mode, OFlags, linkat, open};
    use std::fs::{self, File};
    use std::io;
    use std::os::fd::AsRawFd;
    use std::os::unix::fs::MetadataExt;
    use std::path::{Path, PathBuf};

    /// Makes a file on the file system of `directory`; `None` if the system cannot make one that
    /// can be named later.
    pub(in crate::film) fn create(directory: &Path) -> Option<File> {
        let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
        let file = File::from(open(directory, flags, Mode::from_raw_mode(0o666)).ok()?);
        let (unnamed, reached) = (file.metadata().ok()?, fs::metadata(path_of(&file)).ok()?);
        let has_path = (unnamed.dev(), unnamed.ino()) == (reached.dev(), reached.ino());
        has_path.then_some(file)
    }

    /// Gives `file` the name `path`, which must be free.
    pub(in crate::film) fn link(file: &File, path: &Path) -> io::Result<()> {
        Ok(linkat(
            CWD,
            path_of(file),
            CWD,
            path,
            AtFlags::SYMLINK_FOLLOW,
        )?)
    }

    /// The path of an unnamed file; `None` if `/proc` is not mounted.
    fn path_of(file: &File) -> PathBuf {
        format!("/proc/self/fd/{}", file.as_raw_fd()).into()
    }
}

#[cfg(not(target_os = "linux"))]
pub(super) use elsewhere::{create, link};

#[cfg(not(target_os = "linux"))]
mod elsewhere {
    use std::fs::File;
    use std::io;
    use std::path::Path;

    pub(in crate::film) fn create(_: &Path) -> Option<File> {
        None
    }

    pub(in crate::film) fn link(_: &File, _: &Path) -> io::Result<()> {
        Err(io::ErrorKind::Unsupported.into())
    }
}
