//! `Shape "plymesh"` and `Shape "objmesh"`: meshes in files of their own.

use crate::error::Result;
use crate::input::{self, advise_beside};
use crate::mesh::MeshFormat;
use crate::scene::parameters::Parameters;
use crate::scene::shape_statement::{SURFACE, ShapeTarget};

impl ShapeTarget<'_> {
    /// Adds the triangles of a file of this format.
    pub(in crate::scene) fn add_mesh_file(
        &mut self,
        parameters: &mut Parameters,
        format: MeshFormat,
    ) -> Result<()> {
        parameters.ignore(&SURFACE);
        let Some(filename) = parameters.path("filename")? else {
            let note = "expected \"string filename\" \"mesh.ply\"";
            return Err(parameters
                .missing("filename", "a mesh without a file name")
                .note(note));
        };
        let path = self.directory.join(&filename);
        self.files.add(&path);
        let read = input::refuse_special(&path).and_then(|()| {
            self.mesh_cache
                .read(&path, format, self.keeps_uv, self.budget)
        });
        let loaded = read.map_err(|error| {
            let place = parameters.place_of("filename");
            advise_beside(&place.path, &filename, &path, error).note(format!("named in {place}"))
        })?;
        for warning in loaded.warnings {
            let place = || parameters.place_of("filename");
            self.warnings.add(warning.to_string(), || {
                warning.clone().note(format!("named in {}", place()))
            });
        }
        self.add_mesh(parameters, loaded.mesh)
    }
}
