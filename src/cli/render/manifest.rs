//! The manifest of a batch: a file with a line of JSON for each image.

use super::record::Record;
use crate::cli::files::inputs::{Inputs, check_against_scene};
use crate::cli::files::new_folders::NewFolders;
use crate::cli::files::results::check_extension;
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::words::counted;
use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use crate::file_id::InputFiles;
use crate::json;
use serde::Serialize;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

/// The outcome of an image.
#[derive(Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Status {
    Done,
    /// The image existed already.
    Skipped,
    Failed,
}

/// One line. Field names are its keys.
#[derive(Debug, Serialize)]
pub(super) struct Entry<'a> {
    pub(super) scene: &'a str,
    /// The name in the list of cameras, if there is one and the scene could be read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) camera: Option<&'a str>,
    pub(super) status: Status,
    pub(super) exit_code: u8,
    pub(super) error: Option<String>,
    pub(super) image: Option<&'a Record>,
}

/// The flag that names the file.
const FLAG: &str = "--manifest";

/// How often a writer tries to lock the file, and the pause between; then it goes on without.
const TRIES: usize = 100;
const PAUSE: Duration = Duration::from_millis(10);

/// The open file. A batch that continues later appends to it.
#[derive(Debug)]
pub(super) struct Manifest {
    path: PathBuf,
    file: File,
    /// Lines that could not be written.
    missing: u64,
}

/// The beginning of every line.
const BEGINNING: &[u8] = b"{\"scene\":";

/// Returns true if the file does not begin like a manifest.
fn is_foreign(file: &mut File) -> bool {
    let mut head = Vec::new();
    let read = file.take(BEGINNING.len() as u64).read_to_end(&mut head);
    read.is_ok() && !BEGINNING.starts_with(&head)
}

/// Checks the name of a manifest before anything is read.
///
/// # Errors
/// The name is that of another kind of file, or of one of the `inputs`.
pub(super) fn check(path: &Path, inputs: &Inputs) -> Result<()> {
    inputs.check(path, FLAG)?;
    check_extension(path, FLAG, &["jsonl", "json"])
}

impl Manifest {
    pub(super) fn open(path: &Path) -> Result<Manifest> {
        let _folders = NewFolders::make_for(path)?;
        // Readable, too: the last byte shows whether the last line is complete.
        let open = |reads| {
            OpenOptions::new()
                .create(true)
                .append(true)
                .read(reads)
                .open(path)
        };
        let is_special = path.metadata().is_ok_and(|found| !found.is_file());
        let file = if is_special {
            open(false)
        } else {
            open(true).or_else(|_| open(false))
        };
        let mut file = file.map_err(|error| Error::creating(path, &error))?;
        if !is_special && is_foreign(&mut file) {
            let diagnostic = Diagnostic::new("exists already, and is not a manifest by feimos")
                .at(SourceLocation::file(path))
                .note("give the manifest another name");
            return Err(Error::new(ErrorKind::Output, diagnostic));
        }
        Ok(Manifest {
            path: path.to_path_buf(),
            file,
            missing: 0,
        })
    }

    /// # Errors
    /// The manifest is one of the files that a scene reads.
    pub(super) fn check_against_scene(&self, files: &InputFiles) -> Result<()> {
        check_against_scene(files, &self.path, FLAG)
    }

    /// Appends one line and returns an exit code. An error does not end the batch, and is reported
    /// once.
    pub(super) fn add(&mut self, entry: &Entry, reporter: &Reporter) -> u8 {
        let Err(error) = self.append(json::line(entry)) else {
            return 0;
        };
        self.missing += 1;
        let error = Error::writing(&self.path, &error);
        let code = error.kind().exit_code();
        if self.missing == 1 {
            reporter.error(&error.note("rendering continues; missing lines are counted"));
        }
        code
    }

    /// Reports, at the end, how many lines are missing.
    pub(super) fn report(&self, reporter: &Reporter) {
        if self.missing > 0 {
            let missing = counted(self.missing, "line");
            reporter.line(format_args!("{}: {missing} missing", self.path.display()));
        }
    }

    /// Appends one line, completely or not at all.
    fn append(&mut self, line: Vec<u8>) -> io::Result<()> {
        let is_locked = self.lock();
        let appended = self.append_locked(line);
        if is_locked {
            // The lock ends with the program at the latest.
            let _ = self.file.unlock();
        }
        appended
    }

    /// Locks the file, so that no other process writes while a partial line is removed.
    fn lock(&self) -> bool {
        for _ in 0..TRIES {
            match self.file.try_lock() {
                Ok(()) => return true,
                Err(TryLockError::WouldBlock) => sleep(PAUSE),
                // Not every file system has locks.
                Err(TryLockError::Error(_)) => return false,
            }
        }
        false
    }

    fn append_locked(&mut self, mut line: Vec<u8>) -> io::Result<()> {
        let found = self.file.metadata()?;
        if !found.is_file() {
            return self.file.write_all(&line);
        }
        let size = found.len();
        if self.lacks_line_end(size) {
            line.insert(0, b'\n');
        }
        let written = self.file.write_all(&line);
        if written.is_err() && self.file.metadata().is_ok_and(|found| found.len() > size) {
            // Remove a partial line: readers would stop there, and the next line would continue it.
            let _ = self.file.set_len(size);
        }
        written
    }

    /// Returns true if the file of `size` bytes ends within a line, as after a killed program.
    fn lacks_line_end(&mut self, size: u64) -> bool {
        let Some(last) = size.checked_sub(1) else {
            return false;
        };
        let mut byte = [b'\n'];
        let sought = self.file.seek(SeekFrom::Start(last));
        let read = sought.and_then(|_| self.file.read_exact(&mut byte));
        read.is_ok() && byte != [b'\n']
    }
}
