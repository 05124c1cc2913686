//! The primitives of each shape.

use super::Geometry;
use crate::shape::{PrimitiveId, PrimitiveKind};
use std::ops::Range;

/// Primitives of one kind and one shape that are stored side by side.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShapeRun {
    /// The number of the `Shape` statement, counted from 1.
    pub shape: u32,
    kind: PrimitiveKind,
    indices: Range<usize>,
}

impl ShapeRun {
    /// The number of primitives.
    pub fn count(&self) -> usize {
        self.indices.len()
    }

    /// The first primitive.
    pub fn first(&self) -> PrimitiveId {
        self.primitive(0)
    }

    /// Primitive `place` of the run, counted from 0.
    pub fn primitive(&self, place: usize) -> PrimitiveId {
        let index = self.indices.start + place;
        match self.kind {
            PrimitiveKind::Triangle => PrimitiveId::triangle(index),
            PrimitiveKind::Quadric => PrimitiveId::quadric(index),
            PrimitiveKind::Segment => PrimitiveId::segment(index),
        }
    }
}

impl Geometry {
    /// All primitives in no instance, kind by kind, shape by shape. A shape of two kinds has a run
    /// of each.
    pub fn shape_runs(&self) -> Vec<ShapeRun> {
        let meshes = self.meshes.iter();
        let mut runs: Vec<ShapeRun> = runs_of(
            meshes.map(|run| (run.shape, run.first_triangle as usize)),
            self.triangle_count(),
            PrimitiveKind::Triangle,
        );
        let quadrics = self.quadrics.iter().zip(0..);
        runs.extend(runs_of(
            quadrics.map(|(quadric, index)| (quadric.shape, index)),
            self.quadric_count(),
            PrimitiveKind::Quadric,
        ));
        let curves = self.curves.runs.iter();
        runs.extend(runs_of(
            curves.map(|run| (run.shape, run.first_segment as usize)),
            self.segment_count(),
            PrimitiveKind::Segment,
        ));
        runs
    }
}

/// The runs that begin with these shapes and indices; the last one ends at `end`.
fn runs_of(
    starts: impl Iterator<Item = (u32, usize)>,
    end: usize,
    kind: PrimitiveKind,
) -> Vec<ShapeRun> {
    let mut runs: Vec<ShapeRun> = Vec::new();
    for (shape, start) in starts {
        match runs.last_mut() {
            Some(last) if last.shape == shape => continue,
            Some(last) => last.indices.end = start,
            None => {}
        }
        runs.push(ShapeRun {
            shape,
            kind,
            indices: start..end,
        });
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Point};

    #[test]
    fn runs_cover_all_primitives_of_each_shape() {
        let mut geometry = Geometry::default();
        assert_eq!(geometry.shape_runs(), []);
        let transform = geometry.add_transform(Matrix::IDENTITY);
        let corner = |x: f64| Point::new(x, x * x, 0.0);
        let vertices: Vec<Point> = [0.0, 1.0, 2.0].map(corner).to_vec();
        let identity = &Matrix::IDENTITY;
        let add_mesh = |geometry: &mut Geometry, count: usize, shape: u32| {
            let triangles = vec![[0, 1, 2]; count];
            geometry
                .add_mesh(vertices.clone(), triangles, identity, shape)
                .unwrap();
        };
        add_mesh(&mut geometry, 2, 1);
        add_mesh(&mut geometry, 3, 2);
        for shape in [2, 2, 3] {
            geometry.add_sphere(1.0, None, transform, shape).unwrap();
        }
        let found: Vec<_> = geometry
            .shape_runs()
            .iter()
            .map(|run| (run.shape, run.first(), run.count()))
            .collect();
        let expected = [
            (1, PrimitiveId::triangle(0), 2),
            (2, PrimitiveId::triangle(2), 3),
            (2, PrimitiveId::quadric(0), 2),
            (3, PrimitiveId::quadric(2), 1),
        ];
        assert_eq!(found, expected);
        let runs = geometry.shape_runs();
        let all = runs
            .iter()
            .flat_map(|run| (0..run.count()).map(|place| run.primitive(place)));
        assert!(all.eq(geometry.primitives()));
    }
}
