//! Names of result files: tables, lines of JSON, plots.

use crate::error::{Error, Result};
use std::path::Path;

/// Extensions of result files, which no scene has.
const RESULT_EXTENSIONS: [&str; 5] = ["json", "jsonl", "csv", "md", "svg"];

/// Checks that `path` ends in one of the `extensions`. Devices and pipes may have any name.
///
/// # Errors
/// The name ends otherwise: it may be that of a scene or an image.
pub(crate) fn check_extension(path: &Path, flag: &str, extensions: &[&str]) -> Result<()> {
    let found = path.metadata();
    let is_special = found.is_ok_and(|found| !found.is_file() && !found.is_dir());
    if is_special || has_extension(path, extensions) {
        return Ok(());
    }
    let expected = extensions.iter().map(|extension| format!(".{extension}"));
    let expected = expected.collect::<Vec<_>>().join(" or ");
    let error = Error::usage(format!(
        "{}: {flag} writes another kind of file",
        path.display()
    ));
    Err(error.note(format!("expected a name that ends in {expected}")))
}

/// Refuses result files among the scenes: `--json` is a switch, but the user gave it a file.
/// `json_file` is the flag that takes a file, if the command has one.
///
/// # Errors
/// A scene has the name of a result file.
pub(crate) fn refuse_results<P: AsRef<Path>>(
    scenes: &[P],
    json: bool,
    json_file: Option<&str>,
) -> Result<()> {
    // In `--json -`, the user wants standard output.
    let is_dash = |path: &Path| json_file.is_some() && scenes.len() > 1 && path == Path::new("-");
    let is_result = |path: &&Path| has_extension(path, &RESULT_EXTENSIONS) || is_dash(path);
    let found = scenes.iter().map(AsRef::as_ref).find(is_result);
    let Some(path) = found.filter(|_| json) else {
        return Ok(());
    };
    let name = path.display();
    let error = Error::usage(format!("{name}: this is a result file, not a scene"));
    let error = error.note("--json takes no file name: it prints to standard output");
    Err(match json_file {
        Some(flag) => error.note(format!("did you mean {flag} {name}?")),
        None => error.note(format!("did you mean --json > {name}?")),
    })
}

fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    let found = path
        .extension()
        .map(|extension| extension.to_ascii_lowercase());
    found.is_some_and(|found| extensions.iter().any(|extension| found == *extension))
}
