//! Refuses inputs that are not files: folders, devices, pipes.

use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use std::ffi::OsStr;
use std::fs::{self, FileType};
use std::path::Path;

/// The most entries of a folder that are searched for scenes.
const MOST_ENTRIES: usize = 10_000;

/// Refuses what the user cannot name as an input: folders, and devices, some of which never end.
pub(super) fn refuse_named(path: &Path, file_type: FileType) -> Result<()> {
    if file_type.is_dir() {
        return Err(folder(path));
    }
    if is_device(file_type) {
        return Err(no_file(path, "a device"));
    }
    Ok(())
}

/// Refuses anything but a regular file: opening a pipe may wait forever, and a device may never
/// end.
///
/// # Errors
/// A file that exists and is not regular. Its reader reports a missing one.
pub(crate) fn refuse_special(path: &Path) -> Result<()> {
    let Ok(metadata) = fs::metadata(path) else {
        return Ok(());
    };
    let file_type = metadata.file_type();
    if file_type.is_dir() {
        return Err(no_file(path, "a folder"));
    }
    if is_device(file_type) {
        return Err(no_file(path, "a device"));
    }
    if !file_type.is_file() {
        return Err(no_file(path, "a pipe or a socket"));
    }
    // The kernel's files claim to be regular and empty.
    let is_of_kernel = || {
        fs::canonicalize(path)
            .is_ok_and(|path| path.starts_with("/proc") || path.starts_with("/sys"))
    };
    if metadata.len() == 0 && is_of_kernel() {
        return Err(no_file(path, "a window to the kernel"));
    }
    Ok(())
}

/// The error about a folder that the user names, with the scenes in it as advice.
fn folder(path: &Path) -> Error {
    let error = no_file(path, "a folder");
    let entries = fs::read_dir(path).into_iter().flatten();
    let mut names = entries
        .take(MOST_ENTRIES)
        .filter_map(|entry| Some(entry.ok()?.file_name()));
    let is_scene = |name: &OsStr| Path::new(name).extension() == Some(OsStr::new("pbrt"));
    match names.any(|name| is_scene(&name)) {
        true => error.note(format!(
            "name the scenes in it: `{}`",
            path.join("*.pbrt").display()
        )),
        false => error.note("it has no file `*.pbrt`"),
    }
}

fn no_file(path: &Path, found: &str) -> Error {
    let diagnostic =
        Diagnostic::new(format!("this is {found}, not a file")).at(SourceLocation::file(path));
    Error::new(ErrorKind::MissingInput, diagnostic)
}

#[cfg(unix)]
fn is_device(file_type: FileType) -> bool {
    use std::os::unix::fs::FileTypeExt;
    file_type.is_char_device() || file_type.is_block_device()
}

#[cfg(not(unix))]
fn is_device(_: FileType) -> bool {
    false
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn what_an_input_names_must_be_a_file() {
        let directory = tempfile::tempdir().expect("a directory");
        let socket = directory.path().join("socket");
        let _listener = std::os::unix::net::UnixListener::bind(&socket).expect("a socket");
        assert!(
            refuse_special(&socket)
                .unwrap_err()
                .to_string()
                .ends_with("this is a pipe or a socket, not a file")
        );
        assert!(refuse_special(Path::new("/dev/zero")).is_err());
        assert!(refuse_special(Path::new("Cargo.toml")).is_ok());
        assert!(refuse_special(Path::new("no/such")).is_ok());
        if Path::new("/proc/self/status").exists() {
            assert!(refuse_special(Path::new("/proc/self/status")).is_err());
        }
    }

    #[test]
    fn a_folder_is_answered_with_its_scenes() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path();
        let said = || folder(path).to_string();
        let name = path.display();
        let empty = format!("{name}: this is a folder, not a file\n   = it has no file `*.pbrt`");
        assert_eq!(said(), empty);
        fs::write(path.join("a.pbrt"), "").expect("room");
        let advice = format!("name the scenes in it: `{name}/*.pbrt`");
        assert!(said().ends_with(&advice), "{}", said());
    }
}
