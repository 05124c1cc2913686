//! Suggests the file that a misspelt name may mean.

use crate::error::{Error, ErrorKind};
use std::ffi::OsStr;
use std::fs;
use std::path::{Component, Path, PathBuf};
use unicode_normalization::UnicodeNormalization;

/// The most entries of a folder that are searched for advice.
const MOST_ENTRIES: usize = 10_000;

/// Adds to the `error` of reading the file `path` the name of a similar file.
pub(super) fn advise(path: &Path, error: Error) -> Error {
    let text = path.to_string_lossy();
    let (error, path) = match cfg!(not(windows)) && text.contains('\\') {
        true => (
            error.note("paths take `/` on every system"),
            PathBuf::from(text.replace('\\', "/")),
        ),
        false => (error, path.to_path_buf()),
    };
    if path.exists() {
        return error.note(format!("did you mean `{}`?", path.display()));
    }
    match in_other_letters(&path) {
        Some(found) => error.note(format!(
            "there is `{}`: upper and lower case are different letters here",
            found.display()
        )),
        None => error,
    }
}

/// Adds to the `error` of reading the file `looked_for` the name of a similar file beside the file
/// `naming`, which calls it `name`.
pub(crate) fn advise_beside(naming: &Path, name: &Path, looked_for: &Path, error: Error) -> Error {
    let is_about_it = error
        .diagnostic()
        .location
        .as_ref()
        .is_some_and(|location| location.path == looked_for);
    if error.kind() != ErrorKind::MissingInput || !is_about_it || looked_for.exists() {
        return error;
    }
    let beside = naming.parent().unwrap_or(Path::new("")).join(name);
    if beside == looked_for || !beside.exists() {
        return error;
    }
    let (beside, naming) = (beside.display(), naming.display());
    error.note(format!(
        "there is `{beside}` beside {naming}: names count from the folder of the scene, as in pbrt"
    ))
}

/// The file whose path differs from `path` only by upper and lower case, or by how letters are
/// composed.
fn in_other_letters(path: &Path) -> Option<PathBuf> {
    let mut found = PathBuf::new();
    for component in path.components() {
        let next = found.join(component);
        if fs::symlink_metadata(&next).is_ok() {
            found = next;
            continue;
        }
        let Component::Normal(name) = component else {
            return None;
        };
        let folder = if found.as_os_str().is_empty() {
            Path::new(".")
        } else {
            &found
        };
        let entries = fs::read_dir(folder)
            .ok()?
            .take(MOST_ENTRIES)
            .filter_map(Result::ok);
        let name = folded(name);
        let alike = entries
            .map(|entry| entry.file_name())
            .filter(|entry| folded(entry) == name)
            .min()?;
        found.push(alike);
    }
    (found != path).then_some(found)
}

/// `name` without the difference between upper and lower case.
fn folded(name: &OsStr) -> String {
    name.to_string_lossy().to_lowercase().nfc().collect()
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn what_is_there_under_nearly_the_name_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = folder.path();
        fs::create_dir(root.join("Sub")).expect("room");
        fs::write(root.join("Sub/a.ply"), "").expect("room");
        let advice = |name: &str| {
            let path = root.join(name);
            let error = std::io::Error::from(std::io::ErrorKind::NotFound);
            let notes = advise(&path, Error::reading(&path, &error))
                .diagnostic()
                .notes
                .clone();
            notes
                .join("; ")
                .replace(&format!("{}/", root.display()), "")
        };
        let other_case = "there is `Sub/a.ply`: upper and lower case are different letters here";
        for name in ["sub/a.ply", "SUB/A.PLY", "Sub/A.ply"] {
            assert_eq!(advice(name), other_case);
        }
        assert_eq!(
            advice("Sub\\a.ply"),
            "paths take `/` on every system; did you mean `Sub/a.ply`?"
        );
        assert_eq!(
            advice("sub\\A.ply"),
            format!("paths take `/` on every system; {other_case}")
        );
        assert_eq!(advice("sub\\b.ply"), "paths take `/` on every system");
        assert_eq!(advice("sub/b.ply"), "");
    }
}
