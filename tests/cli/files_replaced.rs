//! The owner and the mode of a file that replaces another; files that killed processes have left.
#![cfg(unix)]

use crate::folder::Folder;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::process::Command;

#[test]
fn a_replaced_file_loses_the_right_to_run_as_its_owner() {
    let folder = Folder::new().with("a.exr", "old");
    for (mode, expected) in [
        (0o640, 0o640),
        (0o4755, 0o755),
        (0o2775, 0o775),
        (0o6711, 0o711),
    ] {
        std::fs::set_permissions(folder.path("a.exr"), PermissionsExt::from_mode(mode)).unwrap();
        folder.render("ball.pbrt -o a.exr").succeeded();
        assert_eq!(
            std::fs::metadata(folder.path("a.exr")).unwrap().mode() & 0o7777,
            expected,
            "{mode:o}"
        );
    }
}

#[test]
fn a_replaced_file_keeps_owner_and_mode() {
    let folder = Folder::new().with("a.exr", "old");
    let path = folder.path("a.exr");
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o660)).unwrap();
    if std::os::unix::fs::chown(&path, Some(12345), Some(54321)).is_err() {
        return; // Only root gives files away.
    }
    folder.render("ball.pbrt -o a.exr").succeeded();
    let found = std::fs::metadata(&path).unwrap();
    assert_eq!(
        (found.uid(), found.gid(), found.mode() & 0o7777),
        (12345, 54321, 0o660)
    );
}

#[test]
#[ignore = "becomes another user: needs root"]
fn a_replaced_file_keeps_neither_owner_nor_mode_if_the_owner_cannot_be_set() {
    let folder = Folder::new().with("a.exr", "old");
    let (path, program) = (folder.path("a.exr"), folder.path("feimos"));
    std::fs::copy(folder.command("").get_program(), &program).unwrap();
    for path in [&folder.path("."), &path] {
        std::fs::set_permissions(path, PermissionsExt::from_mode(0o777)).unwrap();
    }
    std::os::unix::fs::chown(&path, Some(12345), Some(54321)).unwrap();
    let mut user = Command::new("setpriv");
    user.current_dir(folder.path(".")).args([
        "--reuid",
        "50010",
        "--regid",
        "50011",
        "--clear-groups",
        "sh",
        "-c",
    ]);
    let status = user
        .args(["umask 027; exec ./feimos render ball.pbrt -o a.exr -q"])
        .status()
        .unwrap();
    assert!(status.success());
    let found = std::fs::metadata(&path).unwrap();
    assert_eq!(
        (found.uid(), found.gid(), found.mode() & 0o7777),
        (50010, 50011, 0o640)
    );
}

#[test]
fn files_that_killed_processes_have_left_are_removed() {
    let (left, new) = (".feimos-AbCdEf.tmp", ".feimos-GhIjKl.tmp");
    let folder = Folder::new().with(left, "half").with(new, "half");
    // Files of other machines are left alone for a day.
    let days = std::time::Duration::from_secs(2 * 24 * 60 * 60);
    let file = std::fs::File::options().write(true).open(folder.path(left));
    file.unwrap()
        .set_modified(std::time::SystemTime::now() - days)
        .unwrap();
    folder.render("ball.pbrt -o a.exr").succeeded();
    assert_eq!(folder.images(), [new, "a.exr"]);
}
