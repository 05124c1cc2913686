//! Folders for outputs: tried once.

use super::destination::Destination;
use crate::error::Result;
use crate::film::atomic_file::directory_of;
use std::collections::HashSet;
use std::io;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// Folders that accept new files. A trial makes a file, so it is not repeated for each image.
#[derive(Debug, Default)]
pub(crate) struct OpenFolders(Mutex<HashSet<PathBuf>>);

impl OpenFolders {
    /// # Errors
    /// Like [`Destination::check`].
    pub(crate) fn check(&self, destination: &Destination) -> Result<()> {
        let Destination::File(path) = destination else {
            return destination.check();
        };
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // An existing file may be a link to another folder, or protected.
        let found = path.symlink_metadata();
        let is_free = found.is_err_and(|error| error.kind() == io::ErrorKind::NotFound);
        let last = path.as_os_str().as_encoded_bytes().last();
        let names_file = last.is_some_and(u8::is_ascii_alphanumeric);
        if is_free && names_file && known.contains(directory_of(path)) {
            return Ok(());
        }
        destination.check()?;
        if is_free {
            known.insert(directory_of(path).to_path_buf());
        }
        Ok(())
    }
}
