//! Scenes by the names of their files.

use super::accelerator::AcceleratorParameters;
use super::auto_frame::scene_of_mesh;
use super::builder::Builder;
use super::parser;
use super::source::Source;
use super::{LoadOptions, Scene};
use crate::error::Result;
use crate::file_id::InputFiles;
use crate::input::{Budget, BudgetFactor};
use crate::mesh::{self, MeshFormat};
use crate::progress::Progress;
use std::path::Path;

/// Reads a scene with all that it names, or a bare `.ply` or `.obj`; `-` is a scene on standard input.
///
/// `progress` counts bytes of scene files.
pub fn load(path: &Path, options: &LoadOptions, progress: Progress) -> Result<Scene> {
    load_listing_files(path, options, progress).0
}

/// As [`load`]; also returns the files that were read, or tried, up to an error too.
pub fn load_listing_files(
    path: &Path,
    options: &LoadOptions,
    progress: Progress,
) -> (Result<Scene>, InputFiles) {
    if let Some((shape, format)) = bare_mesh(path) {
        let mut files = InputFiles::default();
        files.add(path);
        let budget = Budget::new(options.input_budget);
        let loaded = mesh::read_within(path, format, options.uv, &budget);
        return (
            loaded.and_then(|loaded| scene_of_mesh(path, shape, loaded, options)),
            files,
        );
    }
    let mut builder = Builder::with_options(path, options, progress);
    let read = builder.read_top_level();
    let files = std::mem::take(&mut builder.files);
    (read.and_then(|()| builder.finish(options)), files)
}

/// Reads the bytes of a scene file that `path` would name: errors call it so, and what it includes is sought beside it.
pub fn parse(path: &Path, bytes: Vec<u8>, options: &LoadOptions) -> Result<Scene> {
    let mut builder = Builder::with_options(path, options, Progress::SILENT);
    builder.read_text(bytes)?;
    builder.finish(options)
}

/// What a scene says before its world begins, as far as names of images depend on it.
#[derive(Debug, Clone, Default)]
pub struct SceneOptions {
    /// Where the scene's `Film` wants the picture.
    pub film_filename: Option<String>,
    /// How the scene wants to be aggregated.
    pub accelerator: AcceleratorParameters,
}

/// Reads a scene no further than `WorldBegin`, and no mesh; its files may expand to so many times the usual limits.
pub fn read_options(path: &Path, factor: BudgetFactor) -> Result<SceneOptions> {
    if is_bare_mesh(path) {
        return Ok(SceneOptions::default());
    }
    Builder::new(path, factor, Progress::SILENT).read_options()
}

/// Whether a path names a mesh and not a scene: by its extension, `.gz` left aside.
pub fn is_bare_mesh(path: &Path) -> bool {
    bare_mesh(path).is_some()
}

/// Whether the file `path` is a scene by itself: it begins a world, or cannot be read to find out.
pub fn is_top_level(path: &Path) -> bool {
    Source::read_top_level(path, &Budget::default())
        .map_or(true, |source| parser::begins_world(&source.text))
}

/// What a scene would call the mesh, and its format.
fn bare_mesh(path: &Path) -> Option<(&'static str, MeshFormat)> {
    let name = path.file_name()?.to_str()?.to_ascii_lowercase();
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    if name.ends_with(".ply") {
        Some(("plymesh", MeshFormat::Ply))
    } else if name.ends_with(".obj") {
        Some(("objmesh", MeshFormat::Obj))
    } else {
        None
    }
}
