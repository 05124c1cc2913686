//! All geometry of a scene, in the order of the file.

mod alphas;
mod attributes;
mod curves;
mod cut_outs;
mod digest;
mod forms;
mod hidden;
mod ids;
mod instance;
mod instances;
mod non_finite;
mod order;
mod patches;
mod pose;
mod runs;
mod segments;
mod shape_runs;
mod sizes;
mod surface_attributes;
#[cfg(test)]
mod tests;
mod vertex_normals;

pub use attributes::{CornerUv, CurvePiece, PatchUv};
pub use curves::CurvePoint;
pub use cut_outs::Counts;
pub use instance::Instance;
pub use non_finite::NonFiniteCounts;
pub use pose::Pose;
pub use runs::CapacityError;
pub use shape_runs::ShapeRun;
pub use vertex_normals::CornerNormals;

use crate::geometry::{Matrix, Point};
use crate::shape::{Cut, Form, Primitive, PrimitiveId, PrimitiveKind, Quadric, Triangle};
use attributes::Attributes;
use curves::Curves;
use cut_outs::CutOuts;
use forms::Forms;
use non_finite::move_to_world;
use rayon::prelude::*;
use runs::{FirstNumber, MeshRun, PatchRun, QuadricRun, StoredQuadric, check_room};

/// The geometry of a scene, or of an object. Meshes are in world space, quadrics refer to their
/// transforms, and objects are stored once, with their instances.
///
/// Primitive numbers count from 0 in the order of the file, through all shapes and instances (rule
/// E3). They never change: an accelerator sorts its own references. Shape numbers count `Shape`
/// statements from 1.
///
/// In an object, meshes stay in the space of their files and refer to their transforms: a world
/// vertex is only rounded after the transforms of instance and shape are multiplied (rule R4).
#[derive(Debug, Default)]
pub struct Geometry {
    vertices: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    meshes: Vec<MeshRun>,
    quadrics: Vec<StoredQuadric>,
    quadric_runs: Vec<QuadricRun>,
    /// The forms of the quadrics that are not whole spheres.
    forms: Forms,
    /// Of an object: the transforms of its patches.
    patch_runs: Vec<PatchRun>,
    curves: Curves,
    /// Transforms, and the corners of patches.
    transforms: Vec<Matrix>,
    /// The geometry between `ObjectBegin` and `ObjectEnd`; it has no instances.
    objects: Vec<Geometry>,
    instances: Vec<Instance>,
    /// The number of primitives in all instances.
    instanced: u64,
    /// The number of primitives, in no instance, of surfaces that rays do not meet.
    left_out: u32,
    /// Whether the next quadric begins a run because an instance comes before it.
    ends_run: bool,
    /// The attributes of surfaces, if they are wanted.
    attributes: Option<Box<Attributes>>,
    /// The alphas of surfaces that have one.
    cut_outs: Option<Box<CutOuts>>,
    /// Whether it or one of its objects has some.
    has_cut_outs: bool,
}

impl Geometry {
    /// Appends a mesh, and moves its object-space `vertices` to world space (rule R4). Indices must
    /// be in range. Returns how many vertices are not finite before and after the move.
    pub fn add_mesh(
        &mut self,
        mut vertices: Vec<Point>,
        triangles: Vec<[u32; 3]>,
        world_from_object: &Matrix,
        shape: u32,
    ) -> Result<NonFiniteCounts, CapacityError> {
        self.check_room_for_mesh(&vertices, &triangles)?;
        let broken = move_to_world(&mut vertices, world_from_object);
        self.push_mesh(vertices, triangles, shape, None)?;
        Ok(broken)
    }

    /// Appends a mesh of an object, whose vertices stay in object space. `transform` is a number
    /// from [`Geometry::add_transform`]. Indices must be in range.
    pub fn add_object_mesh(
        &mut self,
        vertices: Vec<Point>,
        triangles: Vec<[u32; 3]>,
        transform: u32,
        shape: u32,
    ) -> Result<(), CapacityError> {
        self.check_room_for_mesh(&vertices, &triangles)?;
        self.push_mesh(vertices, triangles, shape, Some(transform))
    }

    fn check_room_for_mesh(
        &self,
        vertices: &[Point],
        triangles: &[[u32; 3]],
    ) -> Result<(), CapacityError> {
        let all = self.triangles.len() + triangles.len();
        check_room(all, PrimitiveId::MOST_TRIANGLES, "triangles")?;
        match self.vertices.len() + vertices.len() {
            total if total > u32::MAX as usize => Err(CapacityError {
                what: "vertices",
                limit: u32::MAX.into(),
            }),
            _ => Ok(()),
        }
    }

    fn push_mesh(
        &mut self,
        mut vertices: Vec<Point>,
        mut triangles: Vec<[u32; 3]>,
        shape: u32,
        transform: Option<u32>,
    ) -> Result<(), CapacityError> {
        let first_number = self.next_number(triangles.len())?;
        if !triangles.is_empty() {
            let first_triangle = self.triangles.len() as u32;
            self.meshes.push(MeshRun {
                first_triangle,
                first_number,
                shape,
                transform,
            });
        }
        if self.vertices.is_empty() && self.triangles.is_empty() {
            // The first mesh is often the only one: it is moved, not copied.
            (self.vertices, self.triangles) = (vertices, triangles);
        } else {
            let base = self.vertices.len() as u32;
            triangles
                .par_iter_mut()
                .for_each(|corners| *corners = corners.map(|corner| corner + base));
            self.vertices.append(&mut vertices);
            self.triangles.append(&mut triangles);
        }
        Ok(())
    }

    /// Appends a sphere, whole or cut. `transform` is a number from [`Geometry::add_transform`].
    pub fn add_sphere(
        &mut self,
        radius: f64,
        cut: Option<Cut>,
        transform: u32,
        shape: u32,
    ) -> Result<(), CapacityError> {
        self.add_quadric(radius, Form::Sphere(cut), transform, shape)
    }

    /// Appends any quadric but a patch, like [`Geometry::add_sphere`].
    pub fn add_quadric(
        &mut self,
        radius: f64,
        form: Form,
        transform: u32,
        shape: u32,
    ) -> Result<(), CapacityError> {
        check_room(
            self.quadrics.len() + 1,
            PrimitiveId::MOST_CURVED,
            "quadrics",
        )?;
        let first_number = self.next_number(1)?;
        let first_quadric = self.quadrics.len() as u32;
        let follows = !std::mem::take(&mut self.ends_run)
            && self.quadric_runs.last().is_some_and(|run| {
                run.first_number.in_all() + u64::from(first_quadric - run.first_quadric)
                    == first_number.in_all()
            });
        if !follows {
            self.quadric_runs.push(QuadricRun {
                first_quadric,
                first_number,
            });
        }
        self.forms.push(first_quadric, form);
        self.quadrics.push(StoredQuadric {
            radius,
            transform,
            shape,
        });
        Ok(())
    }

    /// Stores a transform and returns its number.
    pub fn add_transform(&mut self, world_from_object: Matrix) -> u32 {
        self.transforms.push(world_from_object);
        (self.transforms.len() - 1) as u32
    }

    /// The number of the next primitive that is in no instance, before `more` are added. `prim`
    /// channels count from 1, in 32 bits.
    fn next_number(&self, more: usize) -> Result<FirstNumber, CapacityError> {
        let next = self.number_count();
        let limit = u64::from(u32::MAX - 1);
        if next + more as u64 > limit {
            return Err(CapacityError {
                what: "primitives",
                limit,
            });
        }
        Ok(FirstNumber {
            alone: next as u32,
            instanced: self.instanced,
        })
    }

    /// Skips the numbers of `count` primitives of a surface that rays do not meet. Numbers follow
    /// the file, whatever is left out (rule E3).
    pub fn leave_out(&mut self, count: usize) -> Result<(), CapacityError> {
        self.next_number(count)?;
        self.left_out += count as u32;
        Ok(())
    }

    /// All vertices in no instance, used or not: in world space, or, in an object, in the space of
    /// their files.
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// Triangle `index`.
    #[inline]
    pub fn triangle(&self, index: usize) -> Triangle {
        let [a, b, c] = self.triangles[index].map(|corner| corner as usize);
        Triangle([self.vertices[a], self.vertices[b], self.vertices[c]])
    }

    /// The indices of a triangle's vertices.
    #[inline]
    pub fn corners_of(&self, index: usize) -> &[u32; 3] {
        &self.triangles[index]
    }

    /// A vertex, in world space.
    #[inline]
    pub fn vertex(&self, place: u32) -> &Point {
        &self.vertices[place as usize]
    }

    /// Quadric `index`. The corners of a patch of an object are in the space of their file.
    pub fn quadric(&self, index: usize) -> Quadric {
        let stored = &self.quadrics[index];
        Quadric {
            world_from_object: self.transforms[stored.transform as usize],
            radius: stored.radius,
            form: self.forms.of(index, self.quadrics.len()),
        }
    }

    /// The transform of this number.
    #[inline]
    pub fn transform(&self, number: u32) -> &Matrix {
        &self.transforms[number as usize]
    }

    /// A primitive in no instance.
    #[inline]
    pub fn own_surface(&self, primitive: PrimitiveId) -> Primitive {
        let index = primitive.index();
        match primitive.kind() {
            PrimitiveKind::Triangle => Primitive::Triangle(self.triangle(index)),
            PrimitiveKind::Quadric => Primitive::Quadric(self.quadric(index)),
            PrimitiveKind::Segment => Primitive::Segment(self.segment(index)),
        }
    }

    #[inline]
    fn mesh_of(&self, triangle: u32) -> &MeshRun {
        if let [mesh] = &self.meshes[..] {
            return mesh;
        }
        let starts = |run: &MeshRun| run.first_triangle <= triangle;
        &self.meshes[self.meshes.partition_point(starts) - 1]
    }
}
