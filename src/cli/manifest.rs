//! The batch's own record: a line of JSON for each image.

use super::record::Record;
use feimos::error::{Error, Result};
use serde::Serialize;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

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

/// The file, opened once. A batch that goes on later appends to it.
#[derive(Debug)]
pub(crate) struct Manifest {
    path: PathBuf,
    file: File,
}

impl Manifest {
    pub(crate) fn open(path: &Path) -> Result<Manifest> {
        let file = OpenOptions::new().create(true).append(true).open(path);
        let file = file.map_err(|error| Error::creating(path, &error))?;
        Ok(Manifest { path: path.to_path_buf(), file })
    }

    /// Appends one line, in one write.
    pub(crate) fn add(&mut self, entry: &Entry) -> Result<()> {
        let mut line = serde_json::to_string(entry).expect("an entry has no keys that JSON lacks");
        line.push('\n');
        self.file.write_all(line.as_bytes()).map_err(|error| Error::writing(&self.path, &error))
    }
}
