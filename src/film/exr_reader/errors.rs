//! Errors of OpenEXR files, still without the name of the file.

use crate::error::{Diagnostic, Error};
use std::fmt::Display;

/// An error in a file whose name is not known here.
pub(super) fn wrong(found: impl Into<String>, expected: impl Display) -> Error {
    Error::bad_input(Diagnostic::new(found).note(format!("expected {expected}")))
}

/// An error in a file that is truncated or damaged.
pub(super) fn incomplete(found: impl Into<String>) -> Error {
    Error::bad_input(Diagnostic::new(found).note(WHOLE))
}

pub(super) fn damaged(what: &str, error: &exr::error::Error) -> Error {
    incomplete(format!(
        "the {what} of this OpenEXR file cannot be read: {error}"
    ))
}

/// The note on a damaged file.
const WHOLE: &str = "the file is truncated or damaged; was its writer interrupted?";
