//! The geometry of a view as peers take it: `f32`, in world space.

use crate::Result;
use feimos::shape::Geometry as SceneGeometry;
use std::collections::HashMap;

/// Either kind; primitives in the order of feimos's numbers.
#[derive(Debug, PartialEq)]
pub(crate) enum Geometry {
    /// A mesh in which corners are shared.
    Triangles {
        /// World space.
        vertices: Vec<[f32; 3]>,
        /// Three places in `vertices` each.
        triangles: Vec<[u32; 3]>,
    },
    /// x, y and z of the centre in world space, and the radius.
    Spheres(Vec<[f32; 4]>),
}

impl Geometry {
    /// The geometry of `shapes`, narrowed.
    ///
    /// # Errors
    /// Where there are triangles and spheres: primitive numbers would need a table.
    pub(crate) fn of(shapes: &SceneGeometry) -> Result<Geometry> {
        match (shapes.triangle_count(), shapes.quadric_count()) {
            (_, 0) => Ok(triangles(shapes)),
            (0, _) => Ok(spheres(shapes)),
            _ => Err("a view holds triangles or spheres, not both".into()),
        }
    }

    /// Primitives.
    pub(crate) fn len(&self) -> usize {
        match self {
            Geometry::Triangles { triangles, .. } => triangles.len(),
            Geometry::Spheres(spheres) => spheres.len(),
        }
    }

    /// "triangles" or "spheres".
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Geometry::Triangles { .. } => "triangles",
            Geometry::Spheres(_) => "spheres",
        }
    }
}

/// Corners that have the same bits become one vertex.
fn triangles(shapes: &SceneGeometry) -> Geometry {
    let mut vertices = Vec::new();
    let mut places = HashMap::with_capacity(shapes.triangle_count());
    let mut place_of = |corner: feimos::geometry::Point| {
        *places
            .entry(corner.to_array().map(f64::to_bits))
            .or_insert_with(|| {
                vertices.push(corner.to_array().map(|coordinate| coordinate as f32));
                (vertices.len() - 1) as u32
            })
    };
    let triangles = (0..shapes.triangle_count())
        .map(|index| shapes.triangle(index).0.map(&mut place_of))
        .collect();
    Geometry::Triangles {
        vertices,
        triangles,
    }
}

fn spheres(shapes: &SceneGeometry) -> Geometry {
    let sphere = |index| {
        let sphere = shapes.quadric(index);
        let [x, y, z] = sphere.world_from_object.column(3);
        [x, y, z, sphere.radius].map(|number| number as f32)
    };
    Geometry::Spheres((0..shapes.quadric_count()).map(sphere).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use feimos::geometry::{Matrix, Point};

    #[test]
    fn corners_are_shared() {
        let corners =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y, 0.0));
        let mut shapes = SceneGeometry::default();
        let moved = Matrix::translate([0.0, 0.0, 5.0]);
        shapes
            .add_mesh(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]], &moved, 1)
            .unwrap();
        let Geometry::Triangles {
            vertices,
            triangles,
        } = Geometry::of(&shapes).unwrap()
        else {
            panic!("spheres")
        };
        assert_eq!(
            vertices,
            [
                [0.0, 0.0, 5.0],
                [1.0, 0.0, 5.0],
                [1.0, 1.0, 5.0],
                [0.0, 1.0, 5.0]
            ]
        );
        assert_eq!(triangles, [[0, 1, 2], [0, 2, 3]]);
    }
}
