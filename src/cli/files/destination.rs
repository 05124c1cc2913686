//! The destination of an output: a file or standard output.

use super::new_folders;
use crate::cli::terminal::stdout::{self, write_to_stdout};
use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use crate::film::atomic_file::Overwrite;
use crate::progress::Progress;
use std::fmt::{self, Display, Formatter};
use std::io::{self, Cursor, Seek, Write};
use std::path::{Path, PathBuf};

#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) enum Destination {
    Stdout,
    File(PathBuf),
}

/// The content of a file.
pub(crate) trait Encode {
    /// Writes the content, to a file or to memory. `progress` counts rows.
    fn encode(&self, out: &mut (impl Write + Seek + Send), progress: Progress) -> io::Result<()>;
}

impl Destination {
    /// The file of that name, or standard output for `-`.
    pub(crate) fn of_name(name: &Path) -> Destination {
        if name == Path::new("-") {
            Destination::Stdout
        } else {
            Destination::File(name.to_path_buf())
        }
    }

    /// The path of a file.
    pub(crate) fn file(&self) -> Option<&Path> {
        match self {
            Destination::File(path) => Some(path),
            Destination::Stdout => None,
        }
    }

    /// Writes all of `content`; a file appears complete or not at all. Makes missing folders.
    /// `progress` counts rows.
    ///
    /// # Errors
    /// The file cannot be made, or exists and must not be replaced; the disk is full; the reader of
    /// standard output has gone.
    pub(crate) fn write(
        &self,
        overwrite: Overwrite,
        content: &impl Encode,
        progress: Progress,
    ) -> Result<()> {
        match self {
            Destination::File(path) => {
                let encode = |out: &mut _| content.encode(out, progress);
                new_folders::write_with_folders(path, overwrite, encode)
            }
            Destination::Stdout => {
                let mut bytes = Cursor::new(Vec::new());
                let encoded = content.encode(&mut bytes, progress);
                write_to_stdout(encoded.map(|()| bytes.into_inner()))
            }
        }
    }

    /// # Errors
    /// The file exists.
    pub(crate) fn check_free(&self) -> Result<()> {
        let Destination::File(file) = self else {
            return Ok(());
        };
        if !file.is_file() {
            return Ok(());
        }
        let diagnostic = Diagnostic::new("exists already").at(SourceLocation::file(file));
        let advice = "use --force to overwrite it, or --skip-existing to skip the image";
        Err(Error::new(ErrorKind::Output, diagnostic.note(advice)))
    }

    /// # Errors
    /// The destination cannot be written, as far as that is known before the work.
    pub(crate) fn check(&self) -> Result<()> {
        match self {
            Destination::File(path) => new_folders::check_with_folders(path),
            Destination::Stdout => stdout::check(),
        }
    }
}

impl Display for Destination {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Destination::Stdout => f.write_str("-"),
            Destination::File(path) => path.display().fmt(f),
        }
    }
}

/// The names of several destinations, for messages.
pub(crate) fn joined<'a>(destinations: impl IntoIterator<Item = &'a Destination>) -> String {
    let names = destinations.into_iter().map(Destination::to_string);
    names.collect::<Vec<_>>().join(", ")
}
