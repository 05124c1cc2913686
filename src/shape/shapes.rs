//! All geometry of a scene, in the order of the file.

use super::{Cut, FilterRay, Form, Primitive, Quadric, Triangle, Verdict};
use crate::exact::{Bracket, Root};
use crate::geometry::{Bounds, Matrix, Point, Ray};
use rayon::prelude::*;
use std::fmt;
use std::ops::Range;

/// The geometry of a scene. Meshes are in world space; spheres keep the number of their transform, and
/// so do cylinders and disks, which are stored among them.
///
/// Primitive numbers count from 0 in the order of the file, through all shapes (rule E3), and never change: an
/// accelerator orders its own references. Shape numbers count `Shape` statements from 1.
#[derive(Debug, Default)]
pub struct Shapes {
    vertices: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    meshes: Vec<MeshRun>,
    spheres: Vec<StoredSphere>,
    sphere_runs: Vec<SphereRun>,
    /// Of those that are not whole spheres, in their order.
    forms: Vec<(u32, Form)>,
    transforms: Vec<Matrix>,
}

/// The triangles of one shape: they and their primitive numbers follow each other.
#[derive(Debug)]
struct MeshRun {
    first_triangle: u32,
    first_number: u32,
    shape: u32,
}

/// Spheres whose primitive numbers follow each other.
#[derive(Debug)]
struct SphereRun {
    first_sphere: u32,
    first_number: u32,
}

#[derive(Debug)]
struct StoredSphere {
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
pub struct Broken {
    /// In the file.
    pub in_object_space: usize,
    /// In the world, where a large number or a broken matrix may have added some.
    pub in_world_space: usize,
}

/// Moves `vertices` to world space, in the one pass over them that has to be.
fn move_to_world(vertices: &mut [Point], world_from_object: &Matrix) -> Broken {
    let count = |vertex: &Point| usize::from(!vertex.is_finite());
    let moved = vertices.par_iter_mut().map(|vertex| {
        let in_object_space = count(vertex);
        *vertex = world_from_object.apply(*vertex);
        Broken { in_object_space, in_world_space: count(vertex) }
    });
    moved.reduce(Broken::default, |a, b| Broken {
        in_object_space: a.in_object_space + b.in_object_space,
        in_world_space: a.in_world_space + b.in_world_space,
    })
}

impl Shapes {
    /// Appends a mesh; its object-space `vertices` are moved to world space (rule R4). Indices must be in range.
    /// Tells how many of the vertices are not finite before and after the move.
    pub fn add_mesh(
        &mut self,
        mut vertices: Vec<Point>,
        mut triangles: Vec<[u32; 3]>,
        world_from_object: &Matrix,
        shape: u32,
    ) -> Result<Broken, CapacityError> {
        self.check_room(self.triangles.len() + triangles.len(), "triangles")?;
        let total_vertices = self.vertices.len() + vertices.len();
        if total_vertices > u32::MAX as usize {
            return Err(CapacityError { what: "vertices", limit: u32::MAX.into() });
        }
        let first_number = self.next_number(triangles.len())?;
        let broken = move_to_world(&mut vertices, world_from_object);
        if !triangles.is_empty() {
            self.meshes.push(MeshRun { first_triangle: self.triangles.len() as u32, first_number, shape });
        }
        if self.vertices.is_empty() && self.triangles.is_empty() {
            // The first mesh is often the only one: take it over as it is.
            (self.vertices, self.triangles) = (vertices, triangles);
        } else {
            let base = self.vertices.len() as u32;
            triangles.par_iter_mut().for_each(|corners| *corners = corners.map(|corner| corner + base));
            self.vertices.append(&mut vertices);
            self.triangles.append(&mut triangles);
        }
        Ok(broken)
    }

    /// Appends a sphere, whole or cut, under transform number `transform`, as [`Shapes::add_transform`] gave it.
    pub fn add_sphere(
        &mut self,
        radius: f64,
        cut: Option<Cut>,
        transform: u32,
        shape: u32,
    ) -> Result<(), CapacityError> {
        self.add_quadric(radius, Form::Sphere(cut), transform, shape)
    }

    /// Appends a sphere, a cylinder or a disk, as [`Shapes::add_sphere`] does.
    pub fn add_quadric(&mut self, radius: f64, form: Form, transform: u32, shape: u32) -> Result<(), CapacityError> {
        self.check_room(self.spheres.len() + 1, "spheres")?;
        let first_number = self.next_number(1)?;
        let first_sphere = self.spheres.len() as u32;
        let follows = self
            .sphere_runs
            .last()
            .is_some_and(|run| run.first_number + (first_sphere - run.first_sphere) == first_number);
        if !follows {
            self.sphere_runs.push(SphereRun { first_sphere, first_number });
        }
        if form != Form::Sphere(None) {
            self.forms.push((first_sphere, form));
        }
        self.spheres.push(StoredSphere { radius, transform, shape });
        Ok(())
    }

    /// Stores a transform and returns its number.
    pub fn add_transform(&mut self, world_from_object: Matrix) -> u32 {
        self.transforms.push(world_from_object);
        (self.transforms.len() - 1) as u32
    }

    fn check_room(&self, count: usize, what: &'static str) -> Result<(), CapacityError> {
        let limit = Primitive::MAX_COUNT as u64;
        if count as u64 > limit { Err(CapacityError { what, limit }) } else { Ok(()) }
    }

    /// The number of the next primitive, where `more` are to come. `prim` channels count from 1, in 32 bits.
    fn next_number(&self, more: usize) -> Result<u32, CapacityError> {
        let next = self.primitive_count();
        let limit = u64::from(u32::MAX - 1);
        if (next + more) as u64 > limit { Err(CapacityError { what: "primitives", limit }) } else { Ok(next as u32) }
    }

    /// Triangles and spheres.
    pub fn primitive_count(&self) -> usize {
        self.triangles.len() + self.spheres.len()
    }

    /// Triangles, those that can never be hit among them.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Spheres, cylinders and disks, those that can never be hit among them.
    pub fn sphere_count(&self) -> usize {
        self.spheres.len()
    }

    /// Bytes that the geometry takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.vertices[..])
            + size_of_val(&self.triangles[..])
            + size_of_val(&self.meshes[..])
            + size_of_val(&self.spheres[..])
            + size_of_val(&self.sphere_runs[..])
            + size_of_val(&self.forms[..])
            + size_of_val(&self.transforms[..])
    }

    /// All vertices in world space, used or not.
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
    pub fn sphere(&self, index: usize) -> Quadric {
        let stored = &self.spheres[index];
        let place = self.forms.binary_search_by_key(&index, |(sphere, _)| *sphere as usize);
        Quadric {
            world_from_object: self.transforms[stored.transform as usize],
            radius: stored.radius,
            form: place.map_or(Form::Sphere(None), |place| self.forms[place].1),
        }
    }

    /// Whether and where `ray` meets a primitive first, as far as floating point can tell.
    #[inline]
    pub fn filter(&self, primitive: Primitive, ray: &FilterRay) -> Verdict {
        let index = primitive.index();
        if primitive.is_sphere() { self.sphere(index).filter(ray) } else { self.triangle(index).filter(ray) }
    }

    /// The `t` at which `ray` meets a primitive first, if it does. The primitive [can be hit](Shapes::can_be_hit), and so
    /// [can the ray hit](Ray::can_hit).
    pub fn exact(&self, primitive: Primitive, ray: &Ray) -> Option<Root> {
        let index = primitive.index();
        if primitive.is_sphere() { self.sphere(index).exact(ray) } else { self.triangle(index).exact(ray) }
    }

    /// Where the `t` lies at which `ray` meets a primitive first, which it is known to do, as far as floating point can tell.
    pub fn t_of_hit(&self, primitive: Primitive, ray: &FilterRay) -> Option<Bracket> {
        if !primitive.is_sphere() {
            return self.triangle(primitive.index()).t_of_hit(ray);
        }
        match self.sphere(primitive.index()).filter(ray) {
            Verdict::Hit(t) => Some(t),
            _ => None,
        }
    }

    /// The `t` at which `ray` meets a primitive first, which it is known to do.
    pub fn exact_t(&self, primitive: Primitive, ray: &Ray) -> Root {
        let index = primitive.index();
        if primitive.is_sphere() {
            self.sphere(index).exact(ray).expect("the ray is known to meet the sphere")
        } else {
            self.triangle(index).exact_t(ray)
        }
    }

    /// Whether any ray can hit a primitive (rules E1, E2, E5 and E6).
    pub fn can_be_hit(&self, primitive: Primitive) -> bool {
        let index = primitive.index();
        if primitive.is_sphere() { self.sphere(index).can_be_hit() } else { self.triangle(index).can_be_hit() }
    }

    /// Whether two primitives are surely one and the same set of points.
    pub fn coincide(&self, a: Primitive, b: Primitive) -> bool {
        let (i, j) = (a.index(), b.index());
        match (a.is_sphere(), b.is_sphere()) {
            (true, true) => self.sphere(i) == self.sphere(j),
            (false, false) => self.triangle(i).coincides_with(&self.triangle(j)),
            _ => false,
        }
    }

    /// All primitives, kind by kind.
    pub fn primitives(&self) -> impl Iterator<Item = Primitive> + use<> {
        let triangles = (0..self.triangles.len()).map(Primitive::triangle);
        triangles.chain((0..self.spheres.len()).map(Primitive::sphere))
    }

    /// The box around a primitive.
    pub fn bounds(&self, primitive: Primitive) -> Bounds {
        let index = primitive.index();
        if primitive.is_sphere() { self.sphere(index).bounds() } else { self.triangle(index).bounds() }
    }

    /// The primitive number, from 0 in the order of the file (rule E3).
    #[inline]
    pub fn number(&self, primitive: Primitive) -> u32 {
        let index = primitive.index() as u32;
        if primitive.is_sphere() {
            let run = &self.sphere_runs[self.sphere_runs.partition_point(|run| run.first_sphere <= index) - 1];
            run.first_number + (index - run.first_sphere)
        } else {
            let run = self.mesh_of(index);
            run.first_number + (index - run.first_triangle)
        }
    }

    /// The triangles of the mesh that a triangle belongs to, and the number of the first.
    pub(super) fn mesh_around(&self, triangle: u32) -> (Range<u32>, u32) {
        let mesh = self.meshes.partition_point(|run| run.first_triangle <= triangle) - 1;
        let end = self.meshes.get(mesh + 1).map_or(u32::MAX, |next| next.first_triangle);
        (self.meshes[mesh].first_triangle..end, self.meshes[mesh].first_number)
    }

    /// The number of the `Shape` statement, from 1.
    #[inline]
    pub fn shape_number(&self, primitive: Primitive) -> u32 {
        if primitive.is_sphere() {
            self.spheres[primitive.index()].shape
        } else {
            self.mesh_of(primitive.index() as u32).shape
        }
    }

    /// Whether `a` comes before `b` in the file: it wins a tie (rule E3).
    pub fn precedes(&self, a: Primitive, b: Primitive) -> bool {
        if a.is_sphere() == b.is_sphere() { a < b } else { self.number(a) < self.number(b) }
    }

    #[inline]
    fn mesh_of(&self, triangle: u32) -> &MeshRun {
        if let [mesh] = &self.meshes[..] {
            return mesh;
        }
        &self.meshes[self.meshes.partition_point(|run| run.first_triangle <= triangle) - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_triangles() -> (Vec<Point>, Vec<[u32; 3]>) {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        (corners.map(|(x, y)| Point::new(x, y, 0.0)).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
    }

    #[test]
    fn vertices_that_break_on_the_way_are_counted() {
        let vertices = [1.0, 1e200, f64::NAN, f64::INFINITY].map(|x| Point::new(x, 0.0, 0.0)).to_vec();
        let moved = Shapes::default().add_mesh(vertices, Vec::new(), &Matrix::scale([1e200, 1.0, 1.0]), 1);
        assert_eq!(moved, Ok(Broken { in_object_space: 2, in_world_space: 3 }));
    }

    #[test]
    fn numbers_follow_the_file_through_all_kinds() {
        let mut shapes = Shapes::default();
        let transform = shapes.add_transform(Matrix::IDENTITY);
        let (vertices, triangles) = two_triangles();
        shapes.add_sphere(1.0, None, transform, 1).unwrap();
        shapes.add_mesh(vertices.clone(), triangles.clone(), &Matrix::IDENTITY, 2).unwrap();
        shapes.add_sphere(2.0, None, transform, 4).unwrap();
        shapes.add_sphere(3.0, None, transform, 5).unwrap();
        shapes.add_mesh(Vec::new(), Vec::new(), &Matrix::IDENTITY, 6).unwrap();
        shapes.add_mesh(vertices, triangles, &Matrix::translate([0.0, 0.0, 9.0]), 7).unwrap();

        let spheres = (0..3).map(Primitive::sphere).map(|p| (shapes.number(p), shapes.shape_number(p)));
        assert_eq!(spheres.collect::<Vec<_>>(), [(0, 1), (3, 4), (4, 5)]);
        let triangles = (0..4).map(Primitive::triangle).map(|p| (shapes.number(p), shapes.shape_number(p)));
        assert_eq!(triangles.collect::<Vec<_>>(), [(1, 2), (2, 2), (5, 7), (6, 7)]);
        assert!(shapes.precedes(Primitive::sphere(0), Primitive::triangle(0)));
        assert!(!shapes.precedes(Primitive::sphere(1), Primitive::triangle(1)));
        assert_eq!(shapes.triangle(3).0[2], Point::new(0.0, 1.0, 9.0));
        assert_eq!(shapes.sphere_runs.len(), 2, "neighbours share a run");
    }
}
