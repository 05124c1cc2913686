//! Errors as exceptions of `feimos.errors`.

use feimos::{Error, ErrorKind};
use pyo3::prelude::*;

/// The exception for an error.
pub(super) fn exception(py: Python<'_>, error: &Error) -> PyErr {
    let class = match error.kind() {
        ErrorKind::Usage => "ArgumentError",
        ErrorKind::BadInput => "InputError",
        ErrorKind::MissingInput => "MissingInputError",
        ErrorKind::Output | ErrorKind::Io => "FileError",
        ErrorKind::TryAgain => "ResourceError",
        _ => "InternalError",
    };
    of_class(py, class, error.to_string())
}

/// The exception `class` of `feimos.errors`.
pub(super) fn of_class(py: Python<'_>, class: &str, message: String) -> PyErr {
    let make = || {
        let class = py.import("feimos.errors")?.getattr(class)?;
        class.call1((message,))
    };
    make().map_or_else(|error| error, PyErr::from_value)
}
