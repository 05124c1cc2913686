//! Loads scenes by the names of their files.

use super::bare_mesh::scene_of_mesh;
use super::interpreter::Interpreter;
use super::scene_text::{self, WINDOW};
use super::{LoadOptions, Scene};
use crate::error::Result;
use crate::file_id::InputFiles;
use crate::input::{Budget, BudgetFactor};
use crate::mesh::{self, MeshFormat};
use crate::progress::Progress;
use std::path::Path;

/// Reads a scene with all files that it names, or a bare mesh, which its extension tells: `.ply`,
/// `.obj`, `.stl` or `.off`. `-` is a scene on standard input.
///
/// `progress` counts bytes of scene files.
pub fn load(path: &Path, options: &LoadOptions, progress: Progress) -> Result<Scene> {
    load_listing_files(path, options, progress).0
}

/// Like [`load`]; also returns the files that were read, or tried before an error.
pub fn load_listing_files(
    path: &Path,
    options: &LoadOptions,
    progress: Progress,
) -> (Result<Scene>, InputFiles) {
    if let Some((shape, format)) = bare_mesh(path) {
        let mut files = InputFiles::default();
        files.add(path);
        let budget = Budget::new(options.input_budget, progress);
        let loaded = mesh::read_within(path, format, options.corners(), &budget);
        progress.check();
        let scene = loaded.and_then(|loaded| scene_of_mesh(path, shape, loaded, options));
        return (scene, files);
    }
    let mut interpreter = Interpreter::new(path, options, progress);
    let read = interpreter.read_top_level();
    let files = interpreter.take_files();
    (read.and_then(|()| interpreter.finish()), files)
}

/// Reads `bytes` as the content of the scene file `path`, which errors name and whose directory has
/// the included files.
pub fn parse(path: &Path, bytes: Vec<u8>, options: &LoadOptions) -> Result<Scene> {
    let mut interpreter = Interpreter::new(path, options, Progress::SILENT);
    interpreter.read_text(bytes)?;
    interpreter.finish()
}

/// The file name in the scene's `Film`, if there is one. Reads a scene no further than `WorldBegin`,
/// and no mesh. Its files may expand to `factor` times the usual limits.
pub fn read_film_filename(path: &Path, factor: BudgetFactor) -> Result<Option<String>> {
    if is_bare_mesh(path) {
        return Ok(None);
    }
    let options = LoadOptions {
        input_budget: factor,
        ..LoadOptions::default()
    };
    let interpreter = Interpreter::new(path, &options, Progress::SILENT);
    interpreter.read_film_filename()
}

/// Whether the extension of a path, apart from `.gz`, is that of a [mesh](MeshFormat).
pub fn is_bare_mesh(path: &Path) -> bool {
    bare_mesh(path).is_some()
}

/// Whether the file `path` is a scene of its own: it has a `WorldBegin`, or cannot be read.
pub fn is_top_level(path: &Path) -> bool {
    scene_text::has_world(path, WINDOW).unwrap_or(true)
}

/// The shape that a scene would call the mesh, and its format.
fn bare_mesh(path: &Path) -> Option<(&'static str, MeshFormat)> {
    let format = MeshFormat::of_extension(path)?;
    let shape = match format {
        MeshFormat::Obj => "objmesh",
        MeshFormat::Ply | MeshFormat::Stl | MeshFormat::Off => "plymesh",
    };
    Some((shape, format))
}
