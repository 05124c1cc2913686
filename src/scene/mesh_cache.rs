//! Mesh files that a scene names more than once: read twice at most.

use crate::error::Result;
use crate::input::Budget;
use crate::mesh::{self, Loaded, MeshFormat};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::{Path, PathBuf};

/// Bytes of meshes that are kept. Others are read again each time.
const MOST_BYTES: u64 = 256 << 20;

/// The meshes that were named twice. Most are named once, so that the first reading is not kept: that would take as much memory again.
#[derive(Debug, Default)]
pub(super) struct MeshCache {
    /// By path and format; `None` of those that were named once, or are too large.
    meshes: HashMap<(PathBuf, MeshFormat), Option<Loaded>>,
    bytes: u64,
}

impl MeshCache {
    /// The mesh in the file `path`. All calls have the same `with_uv`.
    ///
    /// # Errors
    /// As [`mesh::read`].
    pub(super) fn read(
        &mut self,
        path: &Path,
        format: MeshFormat,
        with_uv: bool,
        budget: &Budget,
    ) -> Result<Loaded> {
        match self.meshes.entry((path.to_path_buf(), format)) {
            Entry::Vacant(place) => {
                let loaded = mesh::read_within(path, format, with_uv, budget)?;
                place.insert(None);
                Ok(loaded)
            }
            Entry::Occupied(mut place) => {
                if let Some(loaded) = place.get() {
                    return Ok(loaded.clone());
                }
                let loaded = mesh::read_within(path, format, with_uv, budget)?;
                if self.bytes + loaded.mesh.bytes() <= MOST_BYTES {
                    self.bytes += loaded.mesh.bytes();
                    place.insert(Some(loaded.clone()));
                }
                Ok(loaded)
            }
        }
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
                .read(&path, MeshFormat::Obj, false, &budget)
                .unwrap()
                .mesh
                .vertices[0]
                .z
        });
        assert_eq!(found, [1.0, 2.0, 2.0, 2.0]);
    }
}
