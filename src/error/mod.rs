//! Errors: what is wrong, where, and what to do about it.
//!
//! [`Diagnostic`] is a message with its location. [`Error`] adds the kind that decides the exit
//! code, so that a script can distinguish a wrong file, an unsupported request and a full disk.

mod count;
mod diagnostic;
mod location;
#[cfg(test)]
mod tests;

pub use count::{counted, grouped};
pub use diagnostic::{Diagnostic, printable};
pub use location::{Excerpt, Position, SourceLocation};
pub(crate) use location::{SHOWN_BYTES, TextPosition, is_line_end, shown_from};

use std::fmt;
use std::path::Path;

/// The result of everything that can fail.
pub type Result<T> = std::result::Result<T, Error>;

/// The kind of an error, which decides the exit code.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ErrorKind {
    /// The command line asks for something impossible (2).
    Usage,
    /// A scene or mesh file is wrong (65, `EX_DATAERR`).
    BadInput,
    /// A scene or mesh file does not exist (66, `EX_NOINPUT`).
    MissingInput,
    /// A bug in feimos (70, `EX_SOFTWARE`).
    Internal,
    /// The output cannot be created, or exists and must not be overwritten (73, `EX_CANTCREAT`).
    Output,
    /// Reading or writing failed (74, `EX_IOERR`).
    Io,
    /// A temporary failure: no space, no memory, a stale handle (75, `EX_TEMPFAIL`).
    TryAgain,
    /// The work was cancelled (130). The program never ends with this kind: signals end it.
    Cancelled,
}

impl ErrorKind {
    /// The exit code of the process, from `sysexits.h`.
    pub fn exit_code(self) -> u8 {
        match self {
            ErrorKind::Usage => 2,
            ErrorKind::BadInput => 65,
            ErrorKind::MissingInput => 66,
            ErrorKind::Internal => 70,
            ErrorKind::Output => 73,
            ErrorKind::Io => 74,
            ErrorKind::TryAgain => 75,
            ErrorKind::Cancelled => 130,
        }
    }

    /// The kind of an I/O error: a temporary failure, or `otherwise`.
    fn of_io(error: &std::io::Error, otherwise: ErrorKind) -> ErrorKind {
        use std::io::ErrorKind as Io;
        match error.kind() {
            Io::StorageFull | Io::QuotaExceeded | Io::StaleNetworkFileHandle | Io::OutOfMemory => {
                ErrorKind::TryAgain
            }
            _ => otherwise,
        }
    }
}

/// An error: its kind and its message. [`Display`](fmt::Display) writes the message: the file, the
/// line and the column, what is wrong, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error(Box<(ErrorKind, Diagnostic)>);

impl Error {
    /// An error of `kind` with the message `diagnostic`.
    #[doc(hidden)]
    pub fn new(kind: ErrorKind, diagnostic: Diagnostic) -> Error {
        Error(Box::new((kind, diagnostic)))
    }

    /// The command line asks for something impossible.
    #[doc(hidden)]
    pub fn usage(message: impl Into<String>) -> Error {
        Error::new(ErrorKind::Usage, Diagnostic::new(message))
    }

    /// A scene or mesh is wrong.
    #[doc(hidden)]
    pub fn bad_input(diagnostic: Diagnostic) -> Error {
        Error::new(ErrorKind::BadInput, diagnostic)
    }

    /// `path` could not be read.
    #[doc(hidden)]
    pub fn reading(path: &Path, error: &std::io::Error) -> Error {
        use std::io::ErrorKind as Io;
        let missing = matches!(
            error.kind(),
            Io::NotFound | Io::IsADirectory | Io::NotADirectory | Io::InvalidFilename
        );
        let kind = if missing {
            ErrorKind::MissingInput
        } else {
            ErrorKind::of_io(error, ErrorKind::Io)
        };
        let diagnostic = Diagnostic::new(format!("cannot read: {error}"));
        Error::new(kind, diagnostic.at(SourceLocation::file(path)))
    }

    /// `path` could not be created.
    #[doc(hidden)]
    pub fn creating(path: &Path, error: &std::io::Error) -> Error {
        let kind = ErrorKind::of_io(error, ErrorKind::Output);
        let diagnostic = Diagnostic::new(format!("cannot create: {error}"));
        Error::new(kind, diagnostic.at(SourceLocation::file(path)))
    }

    /// `path` could not be written completely; no file with its name is left.
    #[doc(hidden)]
    pub fn writing(path: &Path, error: &std::io::Error) -> Error {
        let kind = ErrorKind::of_io(error, ErrorKind::Io);
        let diagnostic = Diagnostic::new(format!("cannot write: {error}"));
        Error::new(kind, diagnostic.at(SourceLocation::file(path)))
    }

    /// The kind of the error.
    pub fn kind(&self) -> ErrorKind {
        self.0.0
    }

    /// The message.
    #[doc(hidden)]
    pub fn diagnostic(&self) -> &Diagnostic {
        &self.0.1
    }

    /// The same error with one more line of notes.
    #[doc(hidden)]
    pub fn note(mut self, note: impl Into<String>) -> Error {
        self.0.1.notes.push(note.into());
        self
    }

    /// The same error at `location`, unless it already has one: the innermost helps most.
    #[doc(hidden)]
    pub fn or_at(mut self, location: impl FnOnce() -> SourceLocation) -> Error {
        self.0.1.location.get_or_insert_with(location);
        self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.diagnostic().fmt(f)
    }
}

impl std::error::Error for Error {}
