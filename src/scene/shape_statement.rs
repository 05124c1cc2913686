//! The `Shape` directive: from parameters to geometry.

use super::mesh_cache::MeshCache;
use super::parameters::Parameters;
use super::shape_refusal::ShapeRefusal;
use super::transform_cache::TransformCache;
use super::warnings::Warnings;
use crate::error::{Diagnostic, Error, Result};
use crate::file_id::InputFiles;
use crate::geometry::Matrix;
use crate::input::Budget;
use crate::mesh::{MeshFormat, TriangleMesh};
use crate::shape::{CapacityError, Geometry, NonFiniteCounts};
use std::path::Path;

/// Where shapes go.
pub(super) struct ShapeTarget<'a> {
    pub(super) geometry: &'a mut Geometry,
    pub(super) transforms: &'a mut TransformCache,
    pub(super) warnings: &'a mut Warnings,
    /// Relative file names count from here.
    pub(super) directory: &'a Path,
    /// Where files that are read are noted.
    pub(super) files: &'a mut InputFiles,
    /// The number of the statement, from 1.
    pub(super) number: u32,
    /// Within an object definition this leads to the space of its instances only, and meshes stay as they are in their files.
    pub(super) world_from_object: Matrix,
    pub(super) is_in_object: bool,
    /// Whether somebody wants to know on which side its normals are.
    pub(super) keeps_orientation: bool,
    /// Whether they are turned round; false where nobody wants to know.
    pub(super) is_turned: bool,
    /// Whether to keep what meshes say of u and v.
    pub(super) keeps_uv: bool,
    /// Whether the shape only bounds a medium: then its primitives have numbers, and nothing else.
    pub(super) bounds_medium: bool,
    /// What the scene's files may expand to.
    pub(super) budget: &'a Budget,
    pub(super) mesh_cache: &'a mut MeshCache,
}

/// Shapes of pbrt that feimos has, and its own.
const SUPPORTED: [&str; 8] = [
    "sphere",
    "cylinder",
    "disk",
    "trianglemesh",
    "loopsubdiv",
    "bilinearmesh",
    "plymesh",
    "objmesh",
];

/// Whether feimos has shapes of the type `name`.
pub(super) fn is_supported(name: &str) -> bool {
    SUPPORTED.contains(&name)
}

/// Shapes of pbrt that feimos does not have.
const UNSUPPORTED: [&str; 7] = [
    "cone",
    "curve",
    "heightfield",
    "hyperboloid",
    "nurbs",
    "paraboloid",
    "heightfield2",
];

/// What meshes may say about their surface without moving it.
pub(super) const SURFACE: [&str; 8] = [
    "N",
    "S",
    "uv",
    "st",
    "faceIndices",
    "discarddegenerateUVs",
    "emissionfilename",
    "edgelength",
];

impl ShapeTarget<'_> {
    /// Adds the shape; one that is not supported, or wrong by itself, is a warning. Tells whether there are such
    /// shapes.
    pub(super) fn add(&mut self, mut parameters: Parameters) -> Result<bool> {
        let added = match parameters.entity_name() {
            "sphere" => self.add_sphere(&mut parameters).map_err(ShapeRefusal::from),
            "cylinder" => self
                .add_cylinder(&mut parameters)
                .map_err(ShapeRefusal::from),
            "disk" => self.add_disk(&mut parameters).map_err(ShapeRefusal::from),
            "trianglemesh" => self.add_triangle_mesh(&mut parameters),
            "loopsubdiv" => self.add_subdivision_surface(&mut parameters),
            "bilinearmesh" => self.add_bilinear_mesh(&mut parameters),
            "plymesh" => self
                .add_mesh_file(&mut parameters, MeshFormat::Ply)
                .map_err(ShapeRefusal::from),
            "objmesh" => self
                .add_mesh_file(&mut parameters, MeshFormat::Obj)
                .map_err(ShapeRefusal::from),
            other => {
                self.warn_unsupported(&parameters, other);
                return Ok(false);
            }
        };
        match added {
            Ok(()) if self.is_turned && !self.bounds_medium => {
                self.geometry.turn_normals(self.number)
            }
            Ok(()) => {}
            Err(ShapeRefusal::Scene(error)) => return Err(error),
            Err(ShapeRefusal::Shape { kind, error }) => {
                let kind = format!("{} {kind}", parameters.entity_name());
                let note = "the shape is left out, as in pbrt; its number stays";
                self.warnings
                    .add(kind, || error.diagnostic().clone().note(note));
            }
        }
        self.warn_of_moved_and_cut(&mut parameters);
        parameters.finish(self.warnings);
        Ok(true)
    }

    /// Has the normals be on the other side than they would be.
    pub(super) fn turn_round(&mut self) {
        self.is_turned = self.keeps_orientation && !self.is_turned;
    }

    fn warn_of_moved_and_cut(&mut self, parameters: &mut Parameters) {
        // An alpha of 1 is solid everywhere; a texture may be anything.
        let is_solid = parameters
            .lone_number("alpha")
            .is_some_and(|alpha| alpha >= 1.0);
        if parameters.has("alpha") && !is_solid {
            parameters.warn(
                "alpha",
                "alpha is ignored: the whole surface is solid",
                self.warnings,
            );
        }
        if parameters.has("displacement") {
            parameters.warn(
                "displacement",
                "displacement is ignored: the surface stays where it is",
                self.warnings,
            );
        }
        parameters.ignore(&["shadowalpha"]);
    }

    fn warn_unsupported(&mut self, parameters: &Parameters, name: &str) {
        let diagnostic = Diagnostic::new(format!("the shape `{name}` is not supported: left out"));
        let diagnostic = match super::spelling::closest(name, SUPPORTED.into_iter()) {
            Some(known) if !UNSUPPORTED.contains(&name) => {
                diagnostic.note(format!("did you mean `{known}`?"))
            }
            _ => diagnostic.note(format!("supported are {}", SUPPORTED.join(", "))),
        };
        parameters.warn_at_name(name, diagnostic, self.warnings);
    }

    /// Adds a mesh of triangles in object space, with indices in range.
    pub(super) fn add_mesh(&mut self, parameters: &Parameters, mesh: TriangleMesh) -> Result<()> {
        let stored = self.budget.charge_stored(mesh.bytes());
        stored.map_err(|error| error.or_at(|| parameters.place_of_name()))?;
        let TriangleMesh {
            vertices,
            triangles,
            uv,
        } = mesh;
        if self.bounds_medium {
            return self
                .geometry
                .leave_out(triangles.len())
                .map_err(|error| too_many(parameters, error));
        }
        let transform = self
            .transforms
            .intern(&self.world_from_object, self.geometry);
        let added = if self.is_in_object {
            let broken = NonFiniteCounts::of(&vertices, &self.world_from_object);
            self.geometry
                .add_object_mesh(vertices, triangles, transform, self.number)
                .map(|()| broken)
        } else {
            self.geometry
                .add_mesh(vertices, triangles, &self.world_from_object, self.number)
        };
        let broken = added.map_err(|error| too_many(parameters, error))?;
        uv.into_iter().for_each(|uv| self.geometry.add_uv(uv));
        let lost = broken.in_world_space;
        if lost > 0
            && broken.in_object_space > 0
            && matches!(parameters.entity_name(), "plymesh" | "objmesh")
        {
            // The file's reader has counted them already.
            return Ok(());
        }
        if lost > 0 {
            let message = format!(
                "vertices that are infinite or not a number: {lost}; their triangles are never hit"
            );
            parameters.warn_at_name(
                "non-finite vertices",
                Diagnostic::new(message),
                self.warnings,
            );
        } else if self.world_from_object.is_finite() && self.world_from_object.is_singular() {
            let message = "the transform of this mesh is singular: it is rendered flat";
            parameters.warn_at_name("singular mesh", Diagnostic::new(message), self.warnings);
        }
        Ok(())
    }
}

/// The error of a scene that is too large.
pub(super) fn too_many(parameters: &Parameters, error: CapacityError) -> Error {
    parameters
        .error_at_name(error.to_string())
        .note("split the scene")
}
