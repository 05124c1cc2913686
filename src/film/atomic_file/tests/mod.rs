//! Files appear completely or not at all.

#[cfg(unix)]
mod unix;

use super::write::BUFFER;
use super::*;
use crate::error::{Error, ErrorKind, Result};
use std::fs;
use std::io::{self, Seek, Write};
use std::path::Path;

/// `ENOENT`, and the same number on Windows.
const NO_SUCH_FILE: i32 = 2;

fn directory() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

/// The names in a folder, sorted.
pub(super) fn names_in(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn write_text(path: &Path, overwrite: Overwrite, text: &str) -> Result<u64> {
    write_file(path, overwrite, |out| out.write_all(text.as_bytes()))
}

/// Writes more than the buffer holds, then fails.
fn write_and_fail(path: &Path, kind: io::ErrorKind) -> Error {
    let fail = |out: &mut Out| out.write_all(&[1; 3 * BUFFER]).and(Err(kind.into()));
    write_file(path, Overwrite::Yes, fail).unwrap_err()
}

#[test]
fn creates_and_replaces() {
    let directory = directory();
    let path = directory.path().join("a.exr");
    assert_eq!(write_text(&path, Overwrite::No, "old").unwrap(), 3);
    assert_eq!(write_text(&path, Overwrite::Yes, "newer").unwrap(), 5);
    assert_eq!(fs::read_to_string(&path).unwrap(), "newer");
    assert_eq!(names_in(directory.path()), ["a.exr"]);
}

#[test]
fn writers_may_seek() {
    let directory = directory();
    let path = directory.path().join("a");
    let size = write_file(&path, Overwrite::Yes, |out| {
        out.write_all(b"__cd")?;
        out.rewind()?;
        out.write_all(b"ab")
    });
    assert_eq!(
        (size.unwrap(), fs::read_to_string(&path).unwrap().as_str()),
        (4, "abcd")
    );
}

#[test]
fn a_failing_writer_leaves_nothing() {
    let directory = directory();
    let path = directory.path().join("a.exr");
    let error = write_and_fail(&path, io::ErrorKind::StorageFull);
    assert_eq!(error.kind(), ErrorKind::TryAgain);
    assert_eq!(
        write_and_fail(&path, io::ErrorKind::Other).kind(),
        ErrorKind::Io
    );
    assert!(names_in(directory.path()).is_empty());
}

#[test]
fn a_failing_writer_leaves_the_old_file() {
    let directory = directory();
    let path = directory.path().join("a.exr");
    write_text(&path, Overwrite::Yes, "old").unwrap();
    write_and_fail(&path, io::ErrorKind::Other);
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(names_in(directory.path()), ["a.exr"]);
}

#[test]
fn a_panicking_writer_leaves_nothing() {
    let directory = directory();
    let path = directory.path().join("a.exr");
    let panicking = || write_file(&path, Overwrite::Yes, |_| panic!("on purpose"));
    assert!(std::panic::catch_unwind(panicking).is_err());
    assert!(names_in(directory.path()).is_empty());
}

#[test]
fn an_existing_file_is_kept_without_overwrite() {
    let directory = directory();
    let path = directory.path().join("a.exr");
    write_text(&path, Overwrite::No, "old").unwrap();
    let error = write_file(&path, Overwrite::No, |_| panic!("nothing to write")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Output);
    assert!(
        error
            .to_string()
            .ends_with("a.exr: cannot create: the file exists"),
        "{error}"
    );
}

#[test]
fn a_file_that_appears_meanwhile_is_kept_without_overwrite() {
    let directory = directory();
    let path = directory.path().join("a.exr");
    let error = write_file(&path, Overwrite::No, |_| fs::write(&path, "other")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Output);
    assert_eq!(fs::read_to_string(&path).unwrap(), "other");
    assert_eq!(names_in(directory.path()), ["a.exr"]);
}

#[test]
fn a_missing_directory_is_named() {
    let directory = directory();
    let missing = directory.path().join("out/deep");
    let error = write_text(&missing.join("a.exr"), Overwrite::Yes, "").unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Output);
    let missing = missing.display();
    // The name of the temporary file would not help.
    let expected = format!(
        "{missing}/a.exr: cannot create: {}\n   = create the directory `{missing}` first",
        io::Error::from_raw_os_error(NO_SUCH_FILE)
    );
    assert_eq!(error.to_string(), expected);
}

#[test]
fn a_directory_or_a_file_in_its_place_is_an_error() {
    let directory = directory();
    let error = write_text(directory.path(), Overwrite::Yes, "").unwrap_err();
    assert!(error.kind() == ErrorKind::Output && error.diagnostic().notes.is_empty());
    let file = directory.path().join("file");
    write_text(&file, Overwrite::Yes, "").unwrap();
    let error = write_text(&file.join("a.exr"), Overwrite::Yes, "").unwrap_err();
    assert!(
        error.kind() == ErrorKind::Output && error.diagnostic().notes.is_empty(),
        "{error}"
    );
}

#[test]
fn a_check_predicts_the_errors_of_a_write_and_writes_nothing() {
    let directory = directory();
    let (file, missing) = (
        directory.path().join("file"),
        directory.path().join("out/a.exr"),
    );
    write_text(&file, Overwrite::Yes, "old").unwrap();
    for path in [directory.path().to_path_buf(), file.join("a.exr"), missing] {
        let foretold = check(&path).unwrap_err();
        assert_eq!(
            foretold.kind(),
            write_text(&path, Overwrite::Yes, "").unwrap_err().kind()
        );
        assert_eq!(
            foretold.to_string(),
            write_text(&path, Overwrite::Yes, "")
                .unwrap_err()
                .to_string()
        );
    }
    for path in [file.clone(), directory.path().join("new"), "new".into()] {
        check(&path).unwrap();
    }
    assert_eq!(fs::read_to_string(&file).unwrap(), "old");
    assert_eq!(names_in(directory.path()), ["file"]);
}

#[test]
fn the_longest_name_is_possible() {
    let directory = directory();
    let name = "n".repeat(255);
    write_text(&directory.path().join(&name), Overwrite::Yes, "").unwrap();
    assert_eq!(names_in(directory.path()), [name]);
}
