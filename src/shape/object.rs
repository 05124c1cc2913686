//! Objects, their instances, and where an instance puts its object.

use super::{Geometry, Primitive, PrimitiveId, Quadric, Triangle};
use crate::geometry::Matrix;
use std::ops::Range;

/// What stands between `ObjectBegin` and `ObjectEnd`, stored once.
///
/// Vertices stay as they are in their files, since a world vertex is rounded only after the transforms of instance and shape
/// have been multiplied (rule R4).
#[derive(Debug)]
pub struct Object {
    geometry: Geometry,
}

impl Object {
    pub(super) fn new(geometry: Geometry) -> Object {
        Object { geometry }
    }

    /// The geometry.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    pub(super) fn shapes_mut(&mut self) -> &mut Geometry {
        &mut self.geometry
    }
}

/// One `ObjectInstance`.
#[derive(Debug)]
pub struct Instance {
    pub(super) world_from_instance: Matrix,
    /// The number of its first primitive.
    pub(super) first_number: u64,
    pub(super) object: u32,
}

const _: () = assert!(size_of::<Instance>() == 112, "there may be millions");

impl Instance {
    /// The current transform at the directive.
    pub fn world_from_instance(&self) -> &Matrix {
        &self.world_from_instance
    }

    /// The number of the object.
    pub fn object(&self) -> usize {
        self.object as usize
    }

    /// The number of its first primitive, from 0 in the order of the file.
    pub fn first_number(&self) -> u64 {
        self.first_number
    }
}

/// An object as a transform places it. Knows the whole transform of the mesh that was asked for last.
#[derive(Debug, Clone)]
pub struct Pose<'a> {
    object: &'a Geometry,
    world_from_instance: Matrix,
    /// The triangles of the last mesh, and its transform.
    mesh: Range<u32>,
    world_from_mesh: Matrix,
}

impl<'a> Pose<'a> {
    #[inline]
    pub(crate) fn new(object: &'a Geometry, world_from_instance: Matrix) -> Pose<'a> {
        Pose {
            object,
            world_from_instance,
            mesh: 0..0,
            world_from_mesh: world_from_instance,
        }
    }

    /// A primitive of the object: its vertices, or its quadric, under the product of the transforms of instance and shape.
    #[inline]
    pub fn surface(&mut self, primitive: PrimitiveId) -> Primitive {
        let index = primitive.index();
        if primitive.is_quadric() {
            let quadric = self.object.quadric(index);
            let world_from_object = self.world_from_instance.times(&quadric.world_from_object);
            return Primitive::Quadric(Quadric {
                world_from_object,
                ..quadric
            });
        }
        Primitive::Triangle(self.triangle(index))
    }

    /// Triangle `index` of the object.
    #[inline]
    pub(super) fn triangle(&mut self, index: usize) -> Triangle {
        let triangle = index as u32;
        if !self.mesh.contains(&triangle) {
            self.mesh = self.object.mesh_around(triangle);
            self.world_from_mesh = self
                .world_from_instance
                .times(self.object.transform_of_mesh(triangle));
        }
        Triangle(
            self.object
                .triangle(index)
                .0
                .map(|vertex| self.world_from_mesh.apply(vertex)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::shape::InstancedId;

    fn corners() -> Vec<Point> {
        [(0.1, 0.2), (1.3, 0.4), (1.5, 1.6)]
            .map(|(x, y)| Point::new(x, y, 0.7))
            .to_vec()
    }

    /// Two meshes under different transforms, and a sphere.
    fn object() -> Geometry {
        let mut object = Geometry::default();
        let first = object.add_transform(Matrix::scale([0.1, 0.3, 0.7]));
        let second = object.add_transform(Matrix::translate([0.1, 0.2, 0.3]));
        object
            .add_object_mesh(corners(), vec![[0, 1, 2], [2, 1, 0]], first, 3)
            .unwrap();
        object.add_sphere(2.0, None, second, 4).unwrap();
        object
            .add_object_mesh(corners(), vec![[0, 1, 2]], second, 5)
            .unwrap();
        object
    }

    #[test]
    fn transforms_are_multiplied_before_a_vertex_is_rounded() {
        let mut geometry = Geometry::default();
        let number = geometry.add_object(object());
        let world_from_instance =
            Matrix::translate([0.7, 1e9, -0.3]).times(&Matrix::scale([1.1, 1.3, -1.7]));
        geometry.add_instance(number, world_from_instance).unwrap();
        let product = world_from_instance.times(&Matrix::scale([0.1, 0.3, 0.7]));
        let mut pose = geometry.pose(0);
        let expected = corners()
            .into_iter()
            .map(|corner| product.apply(corner))
            .collect::<Vec<_>>();
        // Forth and back between meshes.
        for index in [0, 2, 1, 0] {
            let Primitive::Triangle(triangle) = pose.surface(PrimitiveId::triangle(index)) else {
                panic!("a triangle")
            };
            assert_eq!(triangle.0.contains(&expected[0]), index != 2);
        }
        let Primitive::Quadric(sphere) = pose.surface(PrimitiveId::quadric(0)) else {
            panic!("a sphere")
        };
        assert_eq!(
            sphere.world_from_object,
            world_from_instance.times(&Matrix::translate([0.1, 0.2, 0.3]))
        );
    }

    #[test]
    fn instances_are_numbered_where_they_stand() {
        let mut geometry = Geometry::default();
        let number = geometry.add_object(object());
        geometry
            .add_mesh(corners(), vec![[0, 1, 2]], &Matrix::IDENTITY, 1)
            .unwrap();
        geometry.add_instance(number, Matrix::IDENTITY).unwrap();
        geometry
            .add_mesh(corners(), vec![[0, 1, 2]], &Matrix::IDENTITY, 6)
            .unwrap();
        geometry.add_instance(number, Matrix::IDENTITY).unwrap();
        let mut numbers: Vec<(u64, u32)> = geometry
            .all()
            .map(|placed| (geometry.number(placed), geometry.shape_number(placed)))
            .collect();
        numbers.sort_unstable();
        let ids = [1, 3, 3, 4, 5, 6, 3, 3, 4, 5];
        assert_eq!(numbers, (0..).zip(ids).collect::<Vec<_>>());
        assert_eq!((geometry.own_count(), geometry.primitive_count()), (2, 10));
        let last_of_first = InstancedId::in_instance(0, PrimitiveId::triangle(2));
        assert!(geometry.precedes(last_of_first, InstancedId::alone(PrimitiveId::triangle(1))));
        assert!(!geometry.precedes(last_of_first, InstancedId::alone(PrimitiveId::triangle(0))));
        assert!(geometry.precedes(
            last_of_first,
            InstancedId::in_instance(1, PrimitiveId::triangle(0))
        ));
    }

    #[test]
    fn too_many_primitives_are_counted_within_instances() {
        let mut geometry = Geometry::default();
        let mut large = Geometry::default();
        let transform = large.add_transform(Matrix::IDENTITY);
        large
            .add_object_mesh(corners(), vec![[0, 1, 2]; 1 << 16], transform, 1)
            .unwrap();
        let number = geometry.add_object(large);
        let add = |geometry: &mut Geometry, count: usize| {
            (0..count).for_each(|_| geometry.add_instance(number, Matrix::IDENTITY).unwrap());
        };
        let last = PrimitiveId::triangle((1 << 16) - 1);
        add(&mut geometry, (1 << 16) - 1);
        let in_last = InstancedId::in_instance((1 << 16) - 2, last);
        assert_eq!(
            (
                geometry.counts_within_instances(),
                geometry.image_number(in_last)
            ),
            (false, u32::MAX - 0xffff)
        );
        add(&mut geometry, 1);
        assert!(geometry.counts_within_instances());
        assert_eq!(geometry.image_number(in_last), 1 << 16);
        assert_eq!(
            geometry.number(InstancedId::in_instance((1 << 16) - 1, last)),
            u64::from(u32::MAX)
        );
    }
}
