//! The numbers of many primitives in an image, one after the other.

use super::{Geometry, InstancedId};
use std::ops::Range;

/// Looks up image numbers; faster for consecutive primitives of one mesh.
pub struct Numbers<'a> {
    geometry: &'a Geometry,
    /// The triangles of the last mesh, and the number of the first.
    mesh: Range<u32>,
    first_number: u32,
    /// The number of its shape.
    shape: u32,
}

impl<'a> Numbers<'a> {
    /// The numbers of `geometry`.
    pub fn new(geometry: &'a Geometry) -> Numbers<'a> {
        Numbers {
            geometry,
            mesh: 0..0,
            first_number: 0,
            shape: 0,
        }
    }

    /// Like [`Geometry::image_number`].
    #[inline]
    pub fn of(&mut self, placed: InstancedId) -> u32 {
        match self.index_in_mesh(placed) {
            Some(index) => self.first_number + index,
            None => self.of_another(placed),
        }
    }

    /// Like [`Geometry::shape_number`].
    #[inline]
    pub fn of_shape(&mut self, placed: InstancedId) -> u32 {
        match self.index_in_mesh(placed) {
            Some(_) => self.shape,
            None => {
                self.of_another(placed);
                self.geometry.shape_number(placed)
            }
        }
    }

    /// The index of a triangle in the last mesh, if it belongs to it.
    #[inline]
    fn index_in_mesh(&self, placed: InstancedId) -> Option<u32> {
        // The index of a triangle is always below the bits of other kinds, except at the end of the
        // last mesh.
        let primitive = placed.primitive();
        let index = primitive.to_bits();
        let is_there =
            self.mesh.contains(&index) && primitive.is_triangle() && placed.instance().is_none();
        is_there.then(|| index - self.mesh.start)
    }

    fn of_another(&mut self, placed: InstancedId) -> u32 {
        let number = self.geometry.image_number(placed);
        let primitive = placed.primitive();
        if placed.instance().is_none() && primitive.is_triangle() {
            self.mesh = self.geometry.mesh_around(primitive.to_bits());
            self.first_number = number - (primitive.to_bits() - self.mesh.start);
            self.shape = self.geometry.shape_number(placed);
        }
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Point};

    #[test]
    fn numbers_do_not_depend_on_what_was_asked_before() {
        let mut geometry = Geometry::default();
        let corners = || {
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)]
                .map(|(x, y)| Point::new(x, y, 0.0))
                .to_vec()
        };
        let transform = geometry.add_transform(Matrix::IDENTITY);
        geometry
            .add_mesh(corners(), vec![[0, 1, 2]; 3], &Matrix::IDENTITY, 1)
            .unwrap();
        geometry.add_sphere(1.0, None, transform, 2).unwrap();
        geometry
            .add_mesh(Vec::new(), Vec::new(), &Matrix::IDENTITY, 3)
            .unwrap();
        geometry
            .add_mesh(corners(), vec![[0, 1, 2]; 2], &Matrix::IDENTITY, 4)
            .unwrap();
        let mut object = Geometry::default();
        object
            .add_object_mesh(corners(), vec![[0, 1, 2]; 2], 0, 5)
            .unwrap();
        let object = geometry.add_object(object);
        geometry.add_instance(object, Matrix::IDENTITY).unwrap();
        geometry
            .add_mesh(corners(), vec![[0, 1, 2]; 2], &Matrix::IDENTITY, 6)
            .unwrap();
        let all: Vec<InstancedId> = geometry.all().collect();
        for a in &all {
            for b in &all {
                let mut numbers = Numbers::new(&geometry);
                assert_eq!(u64::from(numbers.of(*a)), geometry.number(*a) + 1);
                assert_eq!(u64::from(numbers.of(*b)), geometry.number(*b) + 1);
                let mut numbers = Numbers::new(&geometry);
                assert_eq!(numbers.of_shape(*a), geometry.shape_number(*a));
                assert_eq!(numbers.of_shape(*b), geometry.shape_number(*b));
            }
        }
    }
}
