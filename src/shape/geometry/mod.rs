//! All geometry of a scene, in the order of the file.

mod attributes;
mod digest;
mod hidden;
mod instances;
mod order;

pub use attributes::CornerUv;

use crate::geometry::{Matrix, Point};
use crate::shape::object::{Instance, Object};
use crate::shape::{Cut, Form, Primitive, PrimitiveId, Quadric, Triangle};
use attributes::Attributes;
use rayon::prelude::*;
use std::fmt;

/// The geometry of a scene. Meshes are in world space; spheres keep the number of their transform, and so do cylinders and disks,
/// which are stored among them; objects are stored once, with their instances.
///
/// Primitive numbers count from 0 in the order of the file, through all shapes and instances (rule E3), and never change: an
/// accelerator orders its own references. Shape numbers count `Shape` statements from 1.
///
/// The geometry of an [`Object`] is of the same kind, but for its meshes: they stay as they are in their files, and keep the
/// number of their transform.
#[derive(Debug, Default)]
pub struct Geometry {
    vertices: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    meshes: Vec<MeshRun>,
    quadrics: Vec<StoredQuadric>,
    quadric_runs: Vec<QuadricRun>,
    /// Of those that are not whole spheres, in their order.
    forms: Vec<(u32, Form)>,
    transforms: Vec<Matrix>,
    objects: Vec<Object>,
    instances: Vec<Instance>,
    /// Primitive numbers of all instances.
    instanced: u64,
    /// Primitive numbers in no instance that belong to surfaces that rays do not meet.
    left_out: u32,
    /// Whether the next quadric begins a run, since an instance that may have primitives stands before it.
    ends_run: bool,
    /// Of surfaces, where anybody wants to know.
    attributes: Option<Box<Attributes>>,
}

/// The triangles of one shape: they and their primitive numbers follow each other.
#[derive(Debug)]
struct MeshRun {
    first_triangle: u32,
    first_number: FirstNumber,
    shape: u32,
    /// Of a mesh of an object: takes its vertices out of the file's space.
    transform: Option<u32>,
}

/// Spheres whose primitive numbers follow each other.
#[derive(Debug)]
struct QuadricRun {
    first_quadric: u32,
    first_number: FirstNumber,
}

/// The number of the first primitive of a run.
#[derive(Debug, Clone, Copy)]
struct FirstNumber {
    /// Among the primitives that are in no instance.
    alone: u32,
    /// Primitives of instances that come before it.
    instanced: u64,
}

impl FirstNumber {
    fn in_all(self) -> u64 {
        self.instanced + u64::from(self.alone)
    }
}

#[derive(Debug)]
struct StoredQuadric {
    radius: f64,
    transform: u32,
    shape: u32,
}

/// A scene holds more of something than 32-bit numbers can count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CapacityError {
    what: &'static str,
    limit: u64,
}

impl fmt::Display for CapacityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the scene has more than {} {}", self.limit, self.what)
    }
}

/// How many vertices of a mesh have a coordinate that is infinite or NaN.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NonFiniteCounts {
    /// In the file.
    pub in_object_space: usize,
    /// In the world, where a large number or a broken matrix may have added some.
    pub in_world_space: usize,
}

impl NonFiniteCounts {
    /// What [`Geometry::add_mesh`] would tell.
    pub fn of(vertices: &[Point], world_from_object: &Matrix) -> NonFiniteCounts {
        let count =
            |vertex: &Point| NonFiniteCounts::between(vertex, &world_from_object.apply(*vertex));
        vertices
            .par_iter()
            .map(count)
            .reduce(NonFiniteCounts::default, NonFiniteCounts::plus)
    }

    fn between(in_object_space: &Point, in_world_space: &Point) -> NonFiniteCounts {
        let count = |vertex: &Point| usize::from(!vertex.is_finite());
        NonFiniteCounts {
            in_object_space: count(in_object_space),
            in_world_space: count(in_world_space),
        }
    }

    fn plus(self, other: NonFiniteCounts) -> NonFiniteCounts {
        NonFiniteCounts {
            in_object_space: self.in_object_space + other.in_object_space,
            in_world_space: self.in_world_space + other.in_world_space,
        }
    }
}

/// Moves `vertices` to world space, in the one pass over them that has to be.
fn move_to_world(vertices: &mut [Point], world_from_object: &Matrix) -> NonFiniteCounts {
    let moved = vertices.par_iter_mut().map(|vertex| {
        let in_object_space = std::mem::replace(vertex, world_from_object.apply(*vertex));
        NonFiniteCounts::between(&in_object_space, vertex)
    });
    moved.reduce(NonFiniteCounts::default, NonFiniteCounts::plus)
}

impl Geometry {
    /// Appends a mesh; its object-space `vertices` are moved to world space (rule R4). Indices must be in range.
    /// Tells how many of the vertices are not finite before and after the move.
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

    /// Appends a mesh of an object: its vertices stay as they are, under transform number `transform`, as
    /// [`Geometry::add_transform`] gave it. Indices must be in range.
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
        self.check_room(self.triangles.len() + triangles.len(), "triangles")?;
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
            // The first mesh is often the only one: take it over as it is.
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

    /// Appends a sphere, whole or cut, under transform number `transform`, as [`Geometry::add_transform`] gave it.
    pub fn add_sphere(
        &mut self,
        radius: f64,
        cut: Option<Cut>,
        transform: u32,
        shape: u32,
    ) -> Result<(), CapacityError> {
        self.add_quadric(radius, Form::Sphere(cut), transform, shape)
    }

    /// Appends a sphere, a cylinder or a disk, as [`Geometry::add_sphere`] does.
    pub fn add_quadric(
        &mut self,
        radius: f64,
        form: Form,
        transform: u32,
        shape: u32,
    ) -> Result<(), CapacityError> {
        self.check_room(self.quadrics.len() + 1, "spheres")?;
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
        if form != Form::Sphere(None) {
            self.forms.push((first_quadric, form));
        }
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

    fn check_room(&self, count: usize, what: &'static str) -> Result<(), CapacityError> {
        let limit = PrimitiveId::MAX_COUNT as u64;
        if count as u64 > limit {
            Err(CapacityError { what, limit })
        } else {
            Ok(())
        }
    }

    /// The number of the next primitive that is in no instance, where `more` are to come. `prim` channels count from 1, in 32
    /// bits.
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

    /// Passes over the numbers of the next `count` primitives that are in no instance: those of a surface that rays
    /// do not meet. Numbers follow the file, whatever is left out (rule E3).
    pub fn leave_out(&mut self, count: usize) -> Result<(), CapacityError> {
        self.next_number(count)?;
        self.left_out += count as u32;
        Ok(())
    }

    /// Primitive numbers that are in no instance.
    fn number_count(&self) -> u64 {
        self.own_count() as u64 + u64::from(self.left_out)
    }

    /// Triangles and spheres that are in no instance.
    pub fn own_count(&self) -> usize {
        self.triangles.len() + self.quadrics.len()
    }

    /// Triangles that are in no instance, those that can never be hit among them.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Spheres, cylinders and disks that are in no instance, those that can never be hit among them.
    pub fn quadric_count(&self) -> usize {
        self.quadrics.len()
    }

    /// Triangles, those of an object once.
    pub fn stored_triangles(&self) -> usize {
        self.triangles.len()
            + self
                .objects
                .iter()
                .map(|object| object.geometry().triangles.len())
                .sum::<usize>()
    }

    /// Spheres, cylinders and disks, those of an object once.
    pub fn stored_quadrics(&self) -> usize {
        self.quadrics.len()
            + self
                .objects
                .iter()
                .map(|object| object.geometry().quadrics.len())
                .sum::<usize>()
    }

    /// Bytes that the geometry takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.vertices[..])
            + size_of_val(&self.triangles[..])
            + size_of_val(&self.meshes[..])
            + size_of_val(&self.quadrics[..])
            + size_of_val(&self.quadric_runs[..])
            + size_of_val(&self.forms[..])
            + size_of_val(&self.transforms[..])
            + size_of_val(&self.instances[..])
            + self
                .attributes
                .as_ref()
                .map_or(0, |attributes| attributes.bytes())
            + self
                .objects
                .iter()
                .map(|object| size_of::<Object>() + object.geometry().bytes())
                .sum::<usize>()
    }

    /// All vertices that are in no instance, in world space, used or not; of an object's shapes, in the space of their files.
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// Triangle `index` of the store.
    #[inline]
    pub fn triangle(&self, index: usize) -> Triangle {
        let [a, b, c] = self.triangles[index].map(|corner| corner as usize);
        Triangle([self.vertices[a], self.vertices[b], self.vertices[c]])
    }

    /// The places of a triangle's corners among the vertices.
    #[inline]
    pub fn corners_of(&self, index: usize) -> &[u32; 3] {
        &self.triangles[index]
    }

    /// A vertex of triangles, in world space.
    #[inline]
    pub fn vertex(&self, place: u32) -> &Point {
        &self.vertices[place as usize]
    }

    /// Sphere, cylinder or disk `index` of the store.
    pub fn quadric(&self, index: usize) -> Quadric {
        let stored = &self.quadrics[index];
        let place = self
            .forms
            .binary_search_by_key(&index, |(quadric, _)| *quadric as usize);
        Quadric {
            world_from_object: self.transforms[stored.transform as usize],
            radius: stored.radius,
            form: place.map_or(Form::Sphere(None), |place| self.forms[place].1),
        }
    }

    /// A transform that was added.
    #[inline]
    pub fn transform(&self, number: u32) -> &Matrix {
        &self.transforms[number as usize]
    }

    /// A primitive that is in no instance.
    #[inline]
    pub fn own_surface(&self, primitive: PrimitiveId) -> Primitive {
        let index = primitive.index();
        if primitive.is_quadric() {
            Primitive::Quadric(self.quadric(index))
        } else {
            Primitive::Triangle(self.triangle(index))
        }
    }

    /// All primitives that are in no instance, kind by kind.
    pub fn primitives(&self) -> impl Iterator<Item = PrimitiveId> + use<> {
        let triangles = (0..self.triangles.len()).map(PrimitiveId::triangle);
        triangles.chain((0..self.quadrics.len()).map(PrimitiveId::quadric))
    }

    #[inline]
    fn mesh_of(&self, triangle: u32) -> &MeshRun {
        if let [mesh] = &self.meshes[..] {
            return mesh;
        }
        &self.meshes[self
            .meshes
            .partition_point(|run| run.first_triangle <= triangle)
            - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::InstancedId;

    fn two_triangles() -> (Vec<Point>, Vec<[u32; 3]>) {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        (
            corners.map(|(x, y)| Point::new(x, y, 0.0)).to_vec(),
            vec![[0, 1, 2], [0, 2, 3]],
        )
    }

    #[test]
    fn vertices_that_break_on_the_way_are_counted() {
        let vertices = [1.0, 1e200, f64::NAN, f64::INFINITY]
            .map(|x| Point::new(x, 0.0, 0.0))
            .to_vec();
        let moved = Geometry::default().add_mesh(
            vertices,
            Vec::new(),
            &Matrix::scale([1e200, 1.0, 1.0]),
            1,
        );
        assert_eq!(
            moved,
            Ok(NonFiniteCounts {
                in_object_space: 2,
                in_world_space: 3
            })
        );
    }

    #[test]
    fn numbers_follow_the_file_through_all_kinds() {
        let mut geometry = Geometry::default();
        let transform = geometry.add_transform(Matrix::IDENTITY);
        let (vertices, triangles) = two_triangles();
        geometry.add_sphere(1.0, None, transform, 1).unwrap();
        geometry
            .add_mesh(vertices.clone(), triangles.clone(), &Matrix::IDENTITY, 2)
            .unwrap();
        geometry.add_sphere(2.0, None, transform, 4).unwrap();
        geometry.add_sphere(3.0, None, transform, 5).unwrap();
        geometry
            .add_mesh(Vec::new(), Vec::new(), &Matrix::IDENTITY, 6)
            .unwrap();
        geometry
            .add_mesh(vertices, triangles, &Matrix::translate([0.0, 0.0, 9.0]), 7)
            .unwrap();

        let (sphere, triangle) = (
            |index| InstancedId::alone(PrimitiveId::quadric(index)),
            |index| InstancedId::alone(PrimitiveId::triangle(index)),
        );
        let spheres = (0..3)
            .map(sphere)
            .map(|p| (geometry.number(p), geometry.shape_number(p)));
        assert_eq!(spheres.collect::<Vec<_>>(), [(0, 1), (3, 4), (4, 5)]);
        let triangles = (0..4)
            .map(triangle)
            .map(|p| (geometry.number(p), geometry.shape_number(p)));
        assert_eq!(
            triangles.collect::<Vec<_>>(),
            [(1, 2), (2, 2), (5, 7), (6, 7)]
        );
        assert!(geometry.precedes(sphere(0), triangle(0)));
        assert!(!geometry.precedes(sphere(1), triangle(1)));
        assert_eq!(geometry.triangle(3).0[2], Point::new(0.0, 1.0, 9.0));
        assert_eq!(geometry.quadric_runs.len(), 2, "neighbours share a run");
    }
}
