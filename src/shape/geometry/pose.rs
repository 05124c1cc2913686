//! An object at the place of one of its instances.

use super::Geometry;
use crate::geometry::Matrix;
use crate::shape::{Form, Primitive, PrimitiveId, Quadric, Segment, Triangle};
use std::ops::Range;

/// An object under the transform of an instance. Remembers the product with the transform of the
/// last mesh.
#[derive(Debug, Clone)]
pub struct Pose<'a> {
    object: &'a Geometry,
    world_from_instance: Matrix,
    /// The triangles of the last mesh.
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

    /// A primitive of the object, under the product of the transforms of instance and shape.
    #[inline]
    pub fn surface(&mut self, primitive: PrimitiveId) -> Primitive {
        if primitive.is_triangle() {
            return Primitive::Triangle(self.triangle(primitive.index()));
        }
        self.curved_surface(primitive)
    }

    /// A quadric or a segment of the object.
    fn curved_surface(&self, primitive: PrimitiveId) -> Primitive {
        match self.object.own_surface(primitive) {
            triangle @ Primitive::Triangle(_) => triangle,
            Primitive::Quadric(quadric) if quadric.form == Form::Patch => {
                let transform = self.object.transform_of_patch(primitive.index());
                let world_from_file = self.world_from_instance.times(transform);
                let corners = quadric.patch().corners;
                Primitive::Quadric(Quadric {
                    radius: quadric.radius,
                    ..Quadric::of_patch(corners.map(|corner| world_from_file.apply(corner)))
                })
            }
            Primitive::Quadric(quadric) => Primitive::Quadric(Quadric {
                world_from_object: self.world_from_instance.times(&quadric.world_from_object),
                ..quadric
            }),
            Primitive::Segment(segment) => Primitive::Segment(Segment {
                world_from_object: self.world_from_instance.times(&segment.world_from_object),
                ..segment
            }),
        }
    }

    /// Triangle `index` of the object.
    #[inline]
    pub(super) fn triangle(&mut self, index: usize) -> Triangle {
        let world_from_mesh = *self.world_from_mesh(index);
        Triangle(
            self.object
                .triangle(index)
                .0
                .map(|vertex| world_from_mesh.apply(vertex)),
        )
    }

    /// The transform of the mesh of triangle `index` of the object to the world.
    #[inline]
    pub(crate) fn world_from_mesh(&mut self, index: usize) -> &Matrix {
        let triangle = index as u32;
        if !self.mesh.contains(&triangle) {
            self.mesh = self.object.mesh_around(triangle);
            self.world_from_mesh = self
                .world_from_instance
                .times(self.object.transform_of_mesh(triangle));
        }
        &self.world_from_mesh
    }
}
