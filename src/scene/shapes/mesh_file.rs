//! `Shape "plymesh"` and `Shape "objmesh"`: meshes in files of their own.

use crate::error::Result;
use crate::input;
use crate::mesh::MeshFormat;
use crate::scene::parameters::Parameters;
use crate::scene::shape_statement::{SURFACE, ShapeTarget};
use std::path::PathBuf;

impl ShapeTarget<'_> {
    /// Adds the triangles of a file of this format.
    pub(in crate::scene) fn add_mesh_file(&mut self, parameters: &mut Parameters, format: MeshFormat) -> Result<()> {
        parameters.ignore(&SURFACE);
        let Some(filename) = parameters.string("filename")? else {
            let note = "expected \"string filename\" \"mesh.ply\"";
            return Err(parameters.missing("filename", "a mesh without a file name").note(note));
        };
        let path: PathBuf = self.directory.join(filename);
        let read =
            input::refuse_special(&path).and_then(|()| self.mesh_cache.read(&path, format, self.keeps_uv, self.budget));
        let loaded = read.map_err(|error| error.note(format!("named in {}", parameters.place_of("filename"))))?;
        for warning in loaded.warnings {
            let place = || parameters.place_of("filename");
            self.warnings.add(warning.to_string(), || warning.clone().note(format!("named in {}", place())));
        }
        self.add_mesh(parameters, loaded.mesh)
    }
}
