//! Links, permissions and devices.

use super::*;
use std::os::unix::fs::{PermissionsExt, symlink};

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o7777
}

#[test]
fn new_files_have_usual_permissions_and_old_ones_keep_theirs() {
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
fn links_stay_and_their_targets_are_replaced() {
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
fn a_loop_of_links_is_an_error() {
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
fn a_link_is_checked_by_its_target() {
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
fn an_existing_file_behind_a_link_is_kept_without_overwrite() {
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
fn other_names_of_a_file_keep_the_old_content() {
    let directory = directory();
    let (path, other) = (directory.path().join("a"), directory.path().join("b"));
    write_text(&path, Overwrite::Yes, "old").unwrap();
    fs::hard_link(&path, &other).unwrap();
    write_text(&path, Overwrite::Yes, "new").unwrap();
    assert_eq!(fs::read_to_string(&other).unwrap(), "old");
}

#[test]
fn the_right_to_run_as_another_user_is_dropped() {
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
fn devices_are_written_in_place() {
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
