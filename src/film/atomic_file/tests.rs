//! Tests of files that appear whole or not at all.

use super::*;
use crate::error::ErrorKind;

/// `ENOENT`, and the same number on Windows.
const NO_SUCH_FILE: i32 = 2;

fn directory() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn names_in(directory: &Path) -> Vec<String> {
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
fn an_existing_file_is_kept_where_it_must_be() {
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
fn a_file_that_appears_meanwhile_is_kept_where_it_must_be() {
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
    // The name of the temporary file would help nobody.
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
fn a_check_foretells_the_errors_of_writing_and_writes_nothing() {
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
fn the_longest_name_has_room() {
    let directory = directory();
    let name = "n".repeat(255);
    write_text(&directory.path().join(&name), Overwrite::Yes, "").unwrap();
    assert_eq!(names_in(directory.path()), [name]);
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o7777
    }

    #[test]
    fn a_new_file_is_as_readable_as_any_and_an_old_one_as_before() {
        let directory = directory();
        let (plain, path) = (directory.path().join("plain"), directory.path().join("a"));
        fs::write(&plain, "").unwrap();
        write_text(&path, Overwrite::Yes, "").unwrap();
        assert_eq!(mode(&path), mode(&plain));
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        write_text(&path, Overwrite::Yes, "").unwrap();
        assert_eq!(mode(&path), 0o640);
    }

    #[test]
    fn links_stay_and_what_they_lead_to_is_replaced() {
        let directory = directory();
        let (real, link, second) = (
            directory.path().join("sub/real"),
            directory.path().join("link"),
            directory.path().join("second"),
        );
        fs::create_dir(directory.path().join("sub")).unwrap();
        symlink("sub/real", &link).unwrap();
        symlink(&link, &second).unwrap();
        for text in ["through a link to nothing yet", "again"] {
            write_text(&second, Overwrite::Yes, text).unwrap();
            assert_eq!(fs::read_to_string(&real).unwrap(), text);
        }
        assert!(link.is_symlink() && second.is_symlink() && !real.is_symlink());
        assert_eq!(names_in(directory.path()), ["link", "second", "sub"]);
        assert_eq!(names_in(&directory.path().join("sub")), ["real"]);
    }

    #[test]
    fn a_circle_of_links_is_an_error() {
        let directory = directory();
        let link = directory.path().join("link");
        symlink("link", &link).unwrap();
        assert_eq!(
            write_text(&link, Overwrite::Yes, "").unwrap_err().kind(),
            ErrorKind::Output
        );
        assert_eq!(check(&link).unwrap_err().kind(), ErrorKind::Output);
    }

    #[test]
    fn a_link_is_checked_by_where_it_leads() {
        let directory = directory();
        let (link, lost) = (directory.path().join("link"), directory.path().join("lost"));
        symlink("new", &link).unwrap();
        symlink("out/new", &lost).unwrap();
        check(&link).unwrap();
        let missing = directory.path().join("out");
        let note = format!("create the directory `{}` first", missing.display());
        assert_eq!(check(&lost).unwrap_err().diagnostic().notes, [note]);
    }

    #[test]
    fn a_failing_writer_leaves_the_old_file_behind_a_link() {
        let directory = directory();
        let (real, link) = (directory.path().join("real"), directory.path().join("link"));
        write_text(&real, Overwrite::Yes, "old").unwrap();
        symlink("real", &link).unwrap();
        write_and_fail(&link, io::ErrorKind::Other);
        assert_eq!(fs::read_to_string(&link).unwrap(), "old");
        assert_eq!(names_in(directory.path()), ["link", "real"]);
    }

    #[test]
    fn an_existing_file_behind_a_link_is_kept_where_it_must_be() {
        let directory = directory();
        let (real, link) = (directory.path().join("real"), directory.path().join("link"));
        write_text(&real, Overwrite::Yes, "old").unwrap();
        symlink("real", &link).unwrap();
        assert_eq!(
            write_text(&link, Overwrite::No, "new").unwrap_err().kind(),
            ErrorKind::Output
        );
        assert_eq!(fs::read_to_string(&real).unwrap(), "old");
    }

    #[test]
    fn the_other_names_of_a_file_keep_the_old_one() {
        let directory = directory();
        let (path, other) = (directory.path().join("a"), directory.path().join("b"));
        write_text(&path, Overwrite::Yes, "old").unwrap();
        fs::hard_link(&path, &other).unwrap();
        write_text(&path, Overwrite::Yes, "new").unwrap();
        assert_eq!(fs::read_to_string(&other).unwrap(), "old");
    }

    #[test]
    fn rights_of_an_owner_are_not_handed_on() {
        let directory = directory();
        let path = directory.path().join("a");
        write_text(&path, Overwrite::Yes, "").unwrap();
        for (old, expected) in [
            (0o4755, 0o755),
            (0o2770, 0o770),
            (0o6600, 0o600),
            (0o1644, 0o644),
        ] {
            fs::set_permissions(&path, fs::Permissions::from_mode(old)).unwrap();
            write_text(&path, Overwrite::Yes, "").unwrap();
            assert_eq!(mode(&path), expected);
        }
    }

    #[test]
    fn folders_are_synced_through_links() {
        let directory = directory();
        let (path, link) = (directory.path().join("a"), directory.path().join("link"));
        write_text(&path, Overwrite::Yes, "").unwrap();
        symlink("a", &link).unwrap();
        for path in [
            &path,
            &link,
            Path::new("/dev/null"),
            &directory.path().join("gone"),
            Path::new("Cargo.toml"),
        ] {
            sync_folder(path).unwrap();
        }
    }

    #[test]
    fn devices_are_written_to_and_stay() {
        let size = write_file(Path::new("/dev/null"), Overwrite::No, |out| {
            out.write_all(b"abc")?;
            out.rewind()
        });
        assert_eq!(size.unwrap(), 3);
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_full_device_may_be_tried_again() {
        let error = write_text(Path::new("/dev/full"), Overwrite::Yes, "abc").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::TryAgain);
    }
}
