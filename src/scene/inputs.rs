//! The files that a scene reads: where they are, how much they may expand to, meshes read twice.

use super::textures::encoding::Encoding;
use super::textures::image_cache::ImageCache;
use super::textures::image_refusal::ImageRefusal;
use crate::error::Result;
use crate::file_id::InputFiles;
use crate::input::{self, Budget, BudgetFactor};
use crate::mesh::{self, CornerWants, Loaded, MeshFormat};
use crate::progress::Progress;
use crate::texture::Texels;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// All files of one scene.
pub(super) struct Inputs<'a> {
    /// Relative names start here: the directory of the top-level file, as in pbrt.
    directory: PathBuf,
    files: InputFiles,
    budget: Budget<'a>,
    meshes: MeshCache,
    images: ImageCache,
}

impl<'a> Inputs<'a> {
    /// For the scene `path`, whose files may expand to `factor` times the usual limits. Reading
    /// them ends if `progress` cancels it.
    pub(super) fn new(path: &Path, factor: BudgetFactor, progress: Progress<'a>) -> Inputs<'a> {
        Inputs {
            directory: path.parent().unwrap_or(Path::new("")).to_path_buf(),
            files: InputFiles::default(),
            budget: Budget::new(factor, progress),
            meshes: MeshCache::default(),
            images: ImageCache::default(),
        }
    }

    /// The path of the file that the scene calls `name`.
    pub(super) fn resolve(&self, name: &Path) -> PathBuf {
        self.directory.join(name)
    }

    /// Notes a file that is read.
    pub(super) fn add(&mut self, path: &Path) {
        self.files.add(path);
    }

    /// Notes the file that the user named.
    pub(super) fn add_named(&mut self, path: &Path) {
        self.files.add_named(path);
    }

    /// The files that were read, or tried.
    pub(super) fn take_files(&mut self) -> InputFiles {
        std::mem::take(&mut self.files)
    }

    pub(super) fn budget(&self) -> &Budget<'a> {
        &self.budget
    }

    /// Reads the image file `path` as a texture of numbers, once for each encoding.
    pub(super) fn read_texels(
        &mut self,
        path: &Path,
        encoding: Encoding,
    ) -> std::result::Result<Arc<Texels>, ImageRefusal> {
        self.files.add(path);
        self.images.read(path, encoding, &self.budget)
    }

    /// Reads the mesh file `path`.
    pub(super) fn read_mesh(
        &mut self,
        path: &Path,
        format: MeshFormat,
        wants: CornerWants,
    ) -> Result<Loaded> {
        self.files.add(path);
        input::refuse_special(path)?;
        self.meshes.read(path, format, wants, &self.budget)
    }
}

/// Bytes of meshes that are kept. Others are read again each time.
const MOST_BYTES: u64 = 256 << 20;

/// The meshes that were named twice. Most are named once, and keeping them would double their
/// memory.
#[derive(Debug, Default)]
struct MeshCache {
    /// By path, format, and what of corners was read; `None` if the mesh was named once, or is too large.
    meshes: HashMap<(PathBuf, MeshFormat, CornerWants), Option<Loaded>>,
    bytes: u64,
}

impl MeshCache {
    fn read(
        &mut self,
        path: &Path,
        format: MeshFormat,
        wants: CornerWants,
        budget: &Budget,
    ) -> Result<Loaded> {
        let read = || mesh::read_within(path, format, wants, budget);
        let mut place = match self.meshes.entry((path.to_path_buf(), format, wants)) {
            Entry::Vacant(place) => {
                let loaded = read()?;
                place.insert(None);
                return Ok(loaded);
            }
            Entry::Occupied(place) => place,
        };
        if let Some(loaded) = place.get() {
            return Ok(loaded.clone());
        }
        let loaded = read()?;
        if self.bytes + loaded.mesh.bytes() <= MOST_BYTES {
            self.bytes += loaded.mesh.bytes();
            place.insert(Some(loaded.clone()));
        }
        Ok(loaded)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_mesh_is_read_twice_and_then_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        let write =
            |z: u32| fs::write(&path, format!("v 0 0 {z}\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).unwrap();
        let (mut cache, budget) = (MeshCache::default(), Budget::default());
        let found = [1, 2, 3, 4].map(|z| {
            write(z);
            cache
                .read(&path, MeshFormat::Obj, CornerWants::NOTHING, &budget)
                .unwrap()
                .mesh
                .vertices[0]
                .z
        });
        assert_eq!(found, [1.0, 2.0, 2.0, 2.0]);
    }
}
