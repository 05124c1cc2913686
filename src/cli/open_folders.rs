//! Folders that were found to take new files.

use super::output_name::Destination;
use feimos::error::Result;
use feimos::film::atomic_file::directory_of;
use std::collections::HashSet;
use std::io;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// A folder is tried by making a file in it, which many small images should not wait for again and
/// again.
#[derive(Debug, Default)]
pub(crate) struct OpenFolders(Mutex<HashSet<PathBuf>>);

impl OpenFolders {
    /// # Errors
    /// As [`Destination::check`].
    pub(crate) fn check(&self, destination: &Destination) -> Result<()> {
        let Destination::File(path) = destination else {
            return destination.check();
        };
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // What is there may be a link to another folder, or a file that must not be replaced.
        let is_free = path
            .symlink_metadata()
            .is_err_and(|error| error.kind() == io::ErrorKind::NotFound);
        let names_file = path
            .as_os_str()
            .as_encoded_bytes()
            .last()
            .is_some_and(u8::is_ascii_alphanumeric);
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
