//! The geometry and the surroundings that a shape is added to.

use super::transform_cache::TransformCache;
use crate::error::{Diagnostic, Error, Result};
use crate::geometry::{Matrix, Point};
use crate::mesh::CornerWants;
use crate::mesh::TriangleMesh;
use crate::mesh::curve::Diced;
use crate::scene::LoadOptions;
use crate::scene::inputs::Inputs;
use crate::scene::parameters::Parameters;
use crate::scene::textures::{Definition, Textures};
use crate::scene::warnings::Warnings;
use crate::shape::{CapacityError, Form, Geometry, NonFiniteCounts, PatchUv};
use std::sync::Arc;

/// Where one shape goes.
pub(crate) struct ShapeTarget<'a, 'i> {
    pub(crate) geometry: &'a mut Geometry,
    pub(crate) transforms: &'a mut TransformCache,
    pub(crate) warnings: &'a mut Warnings,
    pub(crate) inputs: &'a mut Inputs<'i>,
    pub(crate) options: &'a LoadOptions,
    /// The number of the `Shape` statement, counted from 1.
    pub(crate) number: u32,
    /// In an object definition, the world is the space of the object, and meshes stay in their own
    /// space.
    pub(crate) world_from_object: Matrix,
    pub(crate) is_in_object: bool,
    /// Whether `ReverseOrientation` holds.
    pub(crate) reverses_orientation: bool,
    /// Whether the normals are on the other side than the shape alone would have them.
    pub(crate) is_turned: bool,
    /// Whether rays do not meet the shape, since it only bounds a medium or is hidden by its alpha:
    /// then its primitives only have numbers.
    pub(crate) bounds_medium: bool,
    /// Whether to keep the surface coordinates of meshes: for the options, or for an alpha.
    pub(crate) keeps_uv: bool,
    pub(crate) alpha: AlphaTarget<'a>,
}

/// What the alpha of a shape comes from, and leads to.
pub(crate) struct AlphaTarget<'a> {
    /// The textures that the shape may name.
    pub(crate) textures: &'a Textures,
    /// Whether an alpha at or below the cutoff hides the shape.
    pub(crate) is_hidden: bool,
    /// The texture that the shape is the first to use.
    pub(crate) new_texture: Option<Arc<Definition>>,
}

impl<'a> AlphaTarget<'a> {
    pub(crate) fn new(textures: &'a Textures) -> AlphaTarget<'a> {
        AlphaTarget {
            textures,
            is_hidden: false,
            new_texture: None,
        }
    }
}

/// What a patch takes besides its corners, in bytes, as charged to the budget.
const STORED_PATCH: usize = 96;

/// The result of adding a shape.
pub(super) type ShapeResult<T> = std::result::Result<T, ShapeRefusal>;

/// Why a shape cannot be added.
#[derive(Debug)]
pub(super) enum ShapeRefusal {
    /// The scene cannot be read.
    Scene(Error),
    /// pbrt reports an error, leaves the shape out and continues.
    Shape {
        /// A text that all shapes share that are wrong in this way.
        kind: &'static str,
        error: Error,
    },
}

impl ShapeRefusal {
    pub(super) fn shape(kind: &'static str, error: Error) -> ShapeRefusal {
        ShapeRefusal::Shape { kind, error }
    }
}

impl From<Error> for ShapeRefusal {
    fn from(error: Error) -> ShapeRefusal {
        ShapeRefusal::Scene(error)
    }
}

/// Parameters of meshes that describe the surface without moving it.
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

impl ShapeTarget<'_, '_> {
    /// Leaves the shape out of the picture.
    pub(super) fn hide(&mut self) {
        (self.alpha.is_hidden, self.bounds_medium) = (true, true);
    }

    /// What to keep of the corners of meshes.
    pub(super) fn corners(&self) -> CornerWants {
        CornerWants {
            uv: self.keeps_uv,
            ..self.options.corners()
        }
    }

    /// Puts the normals on the other side.
    pub(super) fn turn_round(&mut self) {
        self.is_turned = !self.is_turned;
    }

    /// Stores the side of the normals, if the options want it.
    pub(super) fn turn_normals(&mut self) {
        if self.options.orientation && self.is_turned && !self.bounds_medium {
            self.geometry.turn_normals(self.number);
        }
    }

    /// Adds a quadric under `world_from_object`.
    pub(super) fn add_quadric(
        &mut self,
        parameters: &Parameters,
        world_from_object: &Matrix,
        radius: f64,
        form: Form,
    ) -> Result<()> {
        let added = if self.bounds_medium {
            self.geometry.leave_out(1)
        } else {
            let transform = self.transforms.intern(world_from_object, self.geometry);
            self.geometry
                .add_quadric(radius, form, transform, self.number)
        };
        added.map_err(|error| too_many(parameters, error))
    }

    /// Adds the segments of a curve in object space: `count` of them.
    pub(super) fn add_curves(
        &mut self,
        parameters: &Parameters,
        diced: Diced,
        count: u64,
    ) -> Result<()> {
        let added = if self.bounds_medium {
            self.geometry.leave_out(count as usize)
        } else {
            let transform = self
                .transforms
                .intern(&self.world_from_object, self.geometry);
            if self.options.orientation || self.keeps_uv {
                self.geometry.add_curve_pieces(&diced.pieces);
            }
            self.geometry
                .add_curves(diced.points, transform, self.number)
        };
        added.map_err(|error| too_many(parameters, error))
    }

    /// Adds a mesh of triangles in object space, with indices in range.
    pub(super) fn add_mesh(&mut self, parameters: &Parameters, mesh: TriangleMesh) -> Result<()> {
        let stored = self.inputs.budget().charge_stored(mesh.bytes());
        stored.map_err(|error| error.or_at(|| parameters.place_of_name()))?;
        if self.bounds_medium {
            let left_out = self.geometry.leave_out(mesh.triangles.len());
            return left_out.map_err(|error| too_many(parameters, error));
        }
        let counts = self
            .store(mesh)
            .map_err(|error| too_many(parameters, error))?;
        self.warn_of_vertices(parameters, counts);
        Ok(())
    }

    /// Adds curved bilinear patches, given their corners p00, p10, p01 and p11 in object space, and
    /// the coordinates there.
    pub(super) fn add_patches(
        &mut self,
        parameters: &Parameters,
        patches: &[[Point; 4]],
        uv: Option<&[PatchUv]>,
    ) -> Result<()> {
        let stored = patches.len() * (size_of::<[Point; 4]>() + STORED_PATCH);
        let stored = self.inputs.budget().charge_stored(stored as u64);
        stored.map_err(|error| error.or_at(|| parameters.place_of_name()))?;
        if self.bounds_medium {
            let left_out = self.geometry.leave_out(patches.len());
            return left_out.map_err(|error| too_many(parameters, error));
        }
        let (matrix, geometry) = (&self.world_from_object, &mut *self.geometry);
        let transform = self
            .is_in_object
            .then(|| self.transforms.intern(matrix, geometry));
        for (place, corners) in patches.iter().enumerate() {
            let added = match transform {
                Some(transform) => geometry.add_object_patch(*corners, transform, self.number),
                None => geometry.add_patch(*corners, matrix, self.number),
            };
            added.map_err(|error| too_many(parameters, error))?;
            if let Some(uv) = uv {
                geometry.add_patch_uv(uv[place]);
            }
        }
        let counts = NonFiniteCounts::of(patches.as_flattened(), matrix);
        self.warn_of_vertices(parameters, counts);
        Ok(())
    }

    /// Warns of vertices that are not finite, and of a transform that makes a mesh flat.
    fn warn_of_vertices(&mut self, parameters: &Parameters, counts: NonFiniteCounts) {
        let count = counts.in_world_space;
        let has_reader_counted = matches!(parameters.entity_name(), "plymesh" | "objmesh");
        let is_singular =
            self.world_from_object.is_finite() && self.world_from_object.is_singular();
        if count > 0 && !(has_reader_counted && counts.in_object_space > 0) {
            let message = format!(
                "vertices that are infinite or not a number: {count}; their triangles are never hit"
            );
            let diagnostic = Diagnostic::new(message);
            parameters.warn_at_name("non-finite vertices", diagnostic, self.warnings);
        } else if count == 0 && is_singular {
            let message = "the transform of this mesh is singular: it is rendered flat";
            parameters.warn_at_name("singular mesh", Diagnostic::new(message), self.warnings);
        }
    }

    fn store(
        &mut self,
        TriangleMesh {
            vertices,
            triangles,
            uv,
            normals,
        }: TriangleMesh,
    ) -> std::result::Result<NonFiniteCounts, CapacityError> {
        let (matrix, geometry) = (&self.world_from_object, &mut *self.geometry);
        let transform = self.transforms.intern(matrix, geometry);
        let counts = if self.is_in_object {
            let counts = NonFiniteCounts::of(&vertices, matrix);
            geometry.add_object_mesh(vertices, triangles, transform, self.number)?;
            counts
        } else {
            geometry.add_mesh(vertices, triangles, matrix, self.number)?
        };
        if let Some(uv) = uv {
            geometry.add_uv(uv);
        }
        if let Some(normals) = normals {
            geometry.add_normals(normals, matrix, self.reverses_orientation);
        }
        Ok(counts)
    }
}

/// The error about a scene that is too large.
fn too_many(parameters: &Parameters, error: CapacityError) -> Error {
    parameters
        .error_at_name(error.to_string())
        .note("split the scene")
}
