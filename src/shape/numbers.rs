//! Numbers of many primitives, one after the other.

use super::{Primitive, Shapes};
use std::ops::Range;

/// Tells the numbers of primitives, quickly where the next is of the same mesh as the last.
pub struct Numbers<'a> {
    shapes: &'a Shapes,
    /// The triangles of the last mesh, and the number of the first.
    mesh: Range<u32>,
    first_number: u32,
}

impl<'a> Numbers<'a> {
    /// Those of `shapes`.
    pub fn of(shapes: &'a Shapes) -> Numbers<'a> {
        Numbers { shapes, mesh: 0..0, first_number: 0 }
    }

    /// As [`Shapes::number`].
    #[inline]
    pub fn of_primitive(&mut self, primitive: Primitive) -> u32 {
        // No index of a triangle is as large as the bits of a sphere, but for the end of the last mesh.
        let index = primitive.to_bits();
        if !self.mesh.contains(&index) || primitive.is_sphere() {
            return self.of_another(primitive);
        }
        self.first_number + (index - self.mesh.start)
    }

    fn of_another(&mut self, primitive: Primitive) -> u32 {
        if !primitive.is_sphere() {
            (self.mesh, self.first_number) = self.shapes.mesh_around(primitive.to_bits());
        }
        self.shapes.number(primitive)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Point};

    #[test]
    fn numbers_do_not_depend_on_what_was_asked_before() {
        let mut shapes = Shapes::default();
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(|(x, y)| Point::new(x, y, 0.0)).to_vec();
        let transform = shapes.add_transform(Matrix::IDENTITY);
        shapes.add_mesh(corners.clone(), vec![[0, 1, 2]; 3], &Matrix::IDENTITY, 1).unwrap();
        shapes.add_sphere(1.0, None, transform, 2).unwrap();
        shapes.add_mesh(Vec::new(), Vec::new(), &Matrix::IDENTITY, 3).unwrap();
        shapes.add_mesh(corners, vec![[0, 1, 2]; 2], &Matrix::IDENTITY, 4).unwrap();
        let all: Vec<Primitive> = (0..5).map(Primitive::triangle).chain([Primitive::sphere(0)]).collect();
        for a in &all {
            for b in &all {
                let mut numbers = Numbers::of(&shapes);
                assert_eq!(numbers.of_primitive(*a), shapes.number(*a));
                assert_eq!(numbers.of_primitive(*b), shapes.number(*b));
            }
        }
    }
}
