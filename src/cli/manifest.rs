//! The batch's own record: a line of JSON for each image.

use super::counted::counted;
use super::inputs::{Inputs, check_against_scene};
use super::record::Record;
use super::reporter::Reporter;
use super::result_files::check_extension;
use feimos::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use feimos::file_id::InputFiles;
use feimos::json;
use serde::Serialize;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

/// How it went with an image.
#[derive(Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Status {
    /// Rendered and written.
    Done,
    /// Its image was there already.
    Skipped,
    /// Not rendered, or not written.
    Failed,
}

/// One line.
#[derive(Debug, Serialize)]
pub(crate) struct Entry<'a> {
    pub(crate) scene: &'a str,
    /// Where there is a list of cameras; none where the scene could not be read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) camera: Option<&'a str>,
    pub(crate) status: Status,
    pub(crate) exit_code: u8,
    pub(crate) error: Option<String>,
    pub(crate) image: Option<&'a Record>,
}

/// The flag that names the file.
const FLAG: &str = "--manifest";

/// How often a writer asks for the lock, and the pause between; after that it goes on without.
const TRIES: usize = 100;
const PAUSE: Duration = Duration::from_millis(10);

/// The file, opened once. A batch that goes on later appends to it.
#[derive(Debug)]
pub(crate) struct Manifest {
    path: PathBuf,
    file: File,
    /// Lines for which there was no room.
    missing: u64,
}

/// What every line begins with.
const BEGINNING: &[u8] = b"{\"scene\":";

/// Returns true if the file does not begin as a manifest does.
fn is_foreign(file: &mut File) -> bool {
    let mut head = Vec::new();
    let read = file.take(BEGINNING.len() as u64).read_to_end(&mut head);
    read.is_ok() && !BEGINNING.starts_with(&head)
}

/// Checks the name of a manifest before anything is read.
///
/// # Errors
/// A name of another kind of file, or of one of the `inputs`.
pub(crate) fn check(path: &Path, inputs: &Inputs) -> Result<()> {
    inputs.check(path, FLAG)?;
    check_extension(path, FLAG, &["jsonl", "json"])
}

impl Manifest {
    pub(crate) fn open(path: &Path) -> Result<Manifest> {
        // To be read, too: the last byte tells whether the last line has an end.
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
            let diagnostic = Diagnostic::new("exists already, and is no manifest")
                .at(SourceLocation::file(path));
            let diagnostic = diagnostic
                .note("lines are added to manifests of feimos alone: give it another name");
            return Err(Error::new(ErrorKind::Output, diagnostic));
        }
        Ok(Manifest {
            path: path.to_path_buf(),
            file,
            missing: 0,
        })
    }

    /// # Errors
    /// A manifest that is one of the files that a scene reads.
    pub(crate) fn check_against_scene(&self, files: &InputFiles) -> Result<()> {
        check_against_scene(files, &self.path, FLAG)
    }

    /// Appends one line. An error does not end the batch: it is told once, and returned as an exit
    /// code.
    pub(crate) fn note(&mut self, entry: &Entry, reporter: &Reporter) -> u8 {
        let Err(error) = self.add(entry) else {
            return 0;
        };
        self.missing += 1;
        let code = error.kind().exit_code();
        if self.missing == 1 {
            reporter.error(&error.note(
                "the images are made all the same; those that are not noted here are counted",
            ));
        }
        code
    }

    /// Says, at the end, how much is not noted.
    pub(crate) fn report(&self, reporter: &Reporter) {
        if self.missing > 0 {
            reporter.line(format_args!(
                "{}: {} missing",
                self.path.display(),
                counted(self.missing, "line")
            ));
        }
    }

    /// Appends one line, in one write: whole, or not at all.
    fn add(&mut self, entry: &Entry) -> Result<()> {
        let line = json::line(entry);
        let is_locked = self.lock();
        let added = self.append(line);
        if is_locked {
            // It ends with the program at the latest.
            let _ = self.file.unlock();
        }
        added.map_err(|error| Error::writing(&self.path, &error))
    }

    /// Locks the file: no other process writes between a line that has no room and its removal.
    fn lock(&self) -> bool {
        for _ in 0..TRIES {
            match self.file.try_lock() {
                Ok(()) => return true,
                Err(TryLockError::WouldBlock) => sleep(PAUSE),
                // Not every file system knows locks.
                Err(TryLockError::Error(_)) => return false,
            }
        }
        false
    }

    fn append(&mut self, mut line: Vec<u8>) -> io::Result<()> {
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
            // A reader of lines would stop at half of one, and the next line would go on there.
            let _ = self.file.set_len(size);
        }
        written
    }

    /// Returns true if the file of `size` bytes ends within a line, as a killed program leaves it.
    fn lacks_line_end(&mut self, size: u64) -> bool {
        let Some(last) = size.checked_sub(1) else {
            return false;
        };
        let mut byte = [b'\n'];
        let read = self
            .file
            .seek(SeekFrom::Start(last))
            .and_then(|_| self.file.read_exact(&mut byte));
        read.is_ok() && byte != [b'\n']
    }
}
