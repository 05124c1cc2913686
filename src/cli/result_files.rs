//! Names of files that hold results: tables, lines of JSON, plots.

use feimos::error::{Error, Result};
use std::path::Path;

/// Extensions of results, which no scene has.
const OF_RESULTS: [&str; 5] = ["json", "jsonl", "csv", "md", "svg"];

/// Checks that `path` ends in one of the `extensions`. Devices and pipes may have any name.
///
/// # Errors
/// Another name, which may be that of a scene or an image.
pub(crate) fn check_extension(path: &Path, flag: &str, extensions: &[&str]) -> Result<()> {
    let is_special = path
        .metadata()
        .is_ok_and(|found| !found.is_file() && !found.is_dir());
    if is_special || has_extension(path, extensions) {
        return Ok(());
    }
    let expected: Vec<String> = extensions
        .iter()
        .map(|extension| format!(".{extension}"))
        .collect();
    let error = Error::usage(format!(
        "{}: {flag} writes no file of this kind",
        path.display()
    ));
    Err(error.note(format!(
        "expected a name that ends in {}",
        expected.join(" or ")
    )))
}

/// Refuses names of results among the scenes: `--json` is a switch, and the user has given it a
/// file. `json_file` is the flag that takes one, if the command has such a flag.
///
/// # Errors
/// A scene by the name of a file of results.
pub(crate) fn refuse_results<P: AsRef<Path>>(
    scenes: &[P],
    json: bool,
    json_file: Option<&str>,
) -> Result<()> {
    if !json {
        return Ok(());
    }
    // `--json -` asks for standard output where `--json` takes a file.
    let is_dash = |path: &Path| json_file.is_some() && scenes.len() > 1 && path == Path::new("-");
    let is_result = |path: &&Path| has_extension(path, &OF_RESULTS) || is_dash(path);
    let Some(path) = scenes.iter().map(AsRef::as_ref).find(is_result) else {
        return Ok(());
    };
    let error = Error::usage(format!(
        "{}: this is the name of a file of results, not of a scene",
        path.display()
    ));
    let error = error.note("--json takes no file: it prints on standard output");
    Err(match json_file {
        Some(flag) => error.note(format!("did you mean {flag} {}?", path.display())),
        None => error.note(format!("did you mean --json > {}?", path.display())),
    })
}

fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    let found = path
        .extension()
        .map(|extension| extension.to_ascii_lowercase());
    found.is_some_and(|found| extensions.iter().any(|extension| found == *extension))
}
