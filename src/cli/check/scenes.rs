//! Finds the scenes in a directory.

use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use crate::scene;
use std::fs::{self, DirEntry};
use std::io;
use std::path::{Path, PathBuf};

/// The scenes that `path` stands for: itself, or the top-level scenes in a directory and in those
/// below, sorted.
///
/// # Errors
/// A directory cannot be read, or has no scene.
pub(super) fn scenes_of(path: &Path) -> Result<Vec<PathBuf>> {
    if !path.is_dir() {
        return Ok(vec![path.to_path_buf()]);
    }
    let mut scenes = Vec::new();
    let mut directories = vec![path.to_path_buf()];
    while let Some(directory) = directories.pop() {
        let reading = |error: io::Error| Error::reading(&directory, &error);
        for entry in fs::read_dir(&directory).map_err(reading)? {
            let entry = entry.map_err(reading)?;
            // Links are not followed: they may form a loop.
            match entry.file_type().map_err(reading)?.is_dir() {
                true => directories.push(entry.path()),
                false if is_scene(&entry) => scenes.push(entry.path()),
                false => {}
            }
        }
    }
    if scenes.is_empty() {
        let diagnostic = Diagnostic::new("no scene in this directory")
            .at(SourceLocation::file(path))
            .note("expected a .pbrt file that has a WorldBegin");
        return Err(Error::new(ErrorKind::MissingInput, diagnostic));
    }
    scenes.sort();
    Ok(scenes)
}

/// Returns true for a file to render, rather than a part of others.
fn is_scene(entry: &DirEntry) -> bool {
    let name = entry.file_name().to_string_lossy().to_ascii_lowercase();
    let path = entry.path();
    (name.ends_with(".pbrt") || name.ends_with(".pbrt.gz"))
        && path.is_file()
        && scene::is_top_level(&path)
}
