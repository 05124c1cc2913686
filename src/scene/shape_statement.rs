//! The `Shape` directive: from parameters to geometry.

use super::declared_type::DeclaredType;
use super::parameters::Parameters;
use super::transform_cache::TransformCache;
use super::warnings::Warnings;
use crate::error::{Diagnostic, Error, Result};
use crate::geometry::{Matrix, Point};
use crate::mesh::{self, Loaded};
use crate::shape::{CapacityError, Cut, Shapes, Sphere};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Where shapes go.
pub(super) struct ShapeTarget<'a> {
    pub(super) shapes: &'a mut Shapes,
    pub(super) transforms: &'a mut TransformCache,
    pub(super) warnings: &'a mut Warnings,
    /// Relative file names count from here.
    pub(super) directory: &'a Path,
    /// The number of the statement, from 1.
    pub(super) number: u32,
    pub(super) world_from_object: Matrix,
}

/// Shapes of pbrt that feimos does not have.
const UNSUPPORTED: [&str; 11] = [
    "bilinearmesh",
    "cone",
    "curve",
    "cylinder",
    "disk",
    "heightfield",
    "hyperboloid",
    "loopsubdiv",
    "nurbs",
    "paraboloid",
    "heightfield2",
];

/// What meshes may say about their surface without moving it.
const SURFACE: [&str; 8] =
    ["N", "S", "uv", "st", "faceIndices", "discarddegenerateUVs", "emissionfilename", "edgelength"];

impl ShapeTarget<'_> {
    /// Adds the shape; a shape that is not supported is a warning.
    pub(super) fn add(&mut self, mut parameters: Parameters) -> Result<()> {
        match parameters.entity_name() {
            "sphere" => self.add_sphere(&mut parameters)?,
            "trianglemesh" => self.add_triangle_mesh(&mut parameters)?,
            "plymesh" => self.add_mesh_file(&mut parameters, mesh::read_ply)?,
            "objmesh" => self.add_mesh_file(&mut parameters, mesh::read_obj)?,
            other => {
                self.warn_unsupported(&parameters, other);
                return Ok(());
            }
        }
        self.warn_of_moved_and_cut(&mut parameters);
        parameters.finish(self.warnings);
        Ok(())
    }

    fn warn_of_moved_and_cut(&mut self, parameters: &mut Parameters) {
        // An alpha of 1 is solid everywhere; a texture may be anything.
        let is_solid = parameters.lone_number("alpha").is_some_and(|alpha| alpha >= 1.0);
        if parameters.has("alpha") && !is_solid {
            parameters.warn("alpha", "alpha is ignored: the whole surface is solid", self.warnings);
        }
        if parameters.has("displacement") {
            parameters.warn("displacement", "displacement is ignored: the surface stays where it is", self.warnings);
        }
        parameters.ignore(&["shadowalpha"]);
    }

    fn warn_unsupported(&mut self, parameters: &Parameters, name: &str) {
        let diagnostic = Diagnostic::new(format!("the shape `{name}` is not supported: left out"));
        let supported = ["sphere", "trianglemesh", "plymesh", "objmesh"];
        let diagnostic = match super::spelling::closest(name, supported.into_iter()) {
            Some(known) if !UNSUPPORTED.contains(&name) => diagnostic.note(format!("did you mean `{known}`?")),
            _ => diagnostic.note(format!("supported are {}", supported.join(", "))),
        };
        parameters.warn_at_name(name, diagnostic, self.warnings);
    }

    fn add_sphere(&mut self, parameters: &mut Parameters) -> Result<()> {
        let radius = parameters.number("radius")?.unwrap_or(1.0);
        let cut = Cut::new(
            radius,
            parameters.number("zmin")?.unwrap_or(-radius),
            parameters.number("zmax")?.unwrap_or(radius),
            parameters.number("phimax")?.unwrap_or(360.0),
        );
        let sphere = Sphere { world_from_object: self.world_from_object, radius, cut };
        if radius.is_nan() || radius <= 0.0 {
            let message = format!("a sphere of radius {radius} is never hit");
            parameters.warn("radius", message, self.warnings);
        } else if !sphere.can_be_hit() {
            let message = "a sphere under a singular or infinite transform is never hit";
            parameters.warn_at_name("singular sphere", Diagnostic::new(message), self.warnings);
        }
        let transform = self.transforms.intern(&self.world_from_object, self.shapes);
        let added = self.shapes.add_sphere(radius, cut, transform, self.number);
        added.map_err(|error| too_many(parameters, error))
    }

    fn add_triangle_mesh(&mut self, parameters: &mut Parameters) -> Result<()> {
        parameters.ignore(&SURFACE);
        let Some(coordinates) = parameters.numbers("P", DeclaredType::POINT)? else {
            return Err(parameters
                .missing("P", "a triangle mesh without vertices")
                .note("expected \"point3 P\" [ ... ]"));
        };
        if !coordinates.len().is_multiple_of(3) {
            let message = format!("`P` has {} numbers, expected three a vertex", coordinates.len());
            return Err(parameters.error_at("P", message));
        }
        let vertices: Vec<Point> = coordinates.par_chunks_exact(3).map(|p| Point::new(p[0], p[1], p[2])).collect();
        let triangles = match parameters.numbers("indices", DeclaredType::INTEGER)? {
            Some(indices) => triangles_of(parameters, indices, vertices.len())?,
            None if vertices.len() == 3 => vec![[0, 1, 2]],
            None => {
                let message = format!("a triangle mesh of {} vertices without `indices`", vertices.len());
                return Err(parameters.missing("indices", message).note("only a mesh of 3 vertices needs none"));
            }
        };
        self.add_mesh(parameters, vertices, triangles)
    }

    fn add_mesh_file(&mut self, parameters: &mut Parameters, read: fn(&Path) -> Result<Loaded>) -> Result<()> {
        parameters.ignore(&SURFACE);
        let Some(filename) = parameters.string("filename")? else {
            let note = "expected \"string filename\" \"mesh.ply\"";
            return Err(parameters.missing("filename", "a mesh without a file name").note(note));
        };
        let path: PathBuf = self.directory.join(filename);
        let loaded =
            read(&path).map_err(|error| error.note(format!("named in {}", parameters.place_of("filename"))))?;
        for warning in loaded.warnings {
            let place = || parameters.place_of("filename");
            self.warnings.add(warning.to_string(), || warning.clone().note(format!("named in {}", place())));
        }
        self.add_mesh(parameters, loaded.mesh.vertices, loaded.mesh.triangles)
    }

    fn add_mesh(&mut self, parameters: &Parameters, vertices: Vec<Point>, triangles: Vec<[u32; 3]>) -> Result<()> {
        self.transforms.intern(&self.world_from_object, self.shapes);
        let added = self.shapes.add_mesh(vertices, triangles, &self.world_from_object, self.number);
        let broken = added.map_err(|error| too_many(parameters, error))?;
        let lost = broken.in_world_space;
        if lost > 0 && broken.in_object_space > 0 && parameters.entity_name() != "trianglemesh" {
            // The file's reader has counted them already.
            return Ok(());
        }
        if lost > 0 {
            let message = format!("vertices that are infinite or not a number: {lost}; their triangles are never hit");
            parameters.warn_at_name("non-finite vertices", Diagnostic::new(message), self.warnings);
        } else if self.world_from_object.is_finite() && self.world_from_object.is_singular() {
            let message = "the transform of this mesh is singular: it is rendered flat";
            parameters.warn_at_name("singular mesh", Diagnostic::new(message), self.warnings);
        }
        Ok(())
    }
}

fn triangles_of(parameters: &Parameters, indices: &[f64], vertex_count: usize) -> Result<Vec<[u32; 3]>> {
    if !indices.len().is_multiple_of(3) {
        let message = format!("`indices` has {} numbers, expected three a triangle", indices.len());
        return Err(parameters.error_at("indices", message));
    }
    let is_wrong = |index: &f64| !is_index(*index, vertex_count);
    if indices.par_iter().any(is_wrong)
        && let Some(place) = indices.iter().position(is_wrong)
    {
        let (index, position) = (indices[place], place + 1);
        let message = format!("index {index}, number {position} of `indices`, names no vertex");
        let expected = match vertex_count {
            0 => "the mesh has no vertices".to_owned(),
            count => format!("expected an integer from 0 to {}", count - 1),
        };
        return Err(parameters.error_at_number("indices", place, message).note(expected));
    }
    Ok(indices.par_chunks_exact(3).map(|corners| [corners[0] as u32, corners[1] as u32, corners[2] as u32]).collect())
}

/// Whether `index` is a whole number below `vertex_count` that 32 bits can hold: only such a one survives the way there and
/// back.
fn is_index(index: f64, vertex_count: usize) -> bool {
    let whole = index as u32;
    f64::from(whole) == index && (whole as usize) < vertex_count
}

fn too_many(parameters: &Parameters, error: CapacityError) -> Error {
    parameters.error_at_name(error.to_string()).note("split the scene")
}

#[cfg(test)]
mod tests {
    use super::is_index;

    #[test]
    fn indices_are_whole_and_in_range() {
        for index in [0.0, -0.0, 1.0, 4_294_967_295.0] {
            assert!(is_index(index, 1 << 32), "{index}");
        }
        for index in [-1.0, 0.5, 1e300, 4_294_967_296.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!is_index(index, usize::MAX), "{index}");
        }
        assert!(is_index(6.0, 7) && !is_index(7.0, 7) && !is_index(0.0, 0));
    }
}
