//! One huge triangle in front of many small ones.

use super::place::camera;
use crate::Result;
use crate::grid::{Grid, bumpy_sphere};
use crate::view::View;
use feimos::geometry::{Matrix, Point};
use feimos::shape::Geometry as SceneGeometry;

/// A ball of a million triangles behind a triangle whose edge crosses the picture: a strip on the right is free.
pub(super) fn view() -> Result<View> {
    let mut shapes = SceneGeometry::default();
    let grid = Grid::of_triangles(1_000_000);
    let mut add = |vertices, triangles, shape| {
        shapes
            .add_mesh(vertices, triangles, &Matrix::IDENTITY, shape)
            .map_err(|error| error.to_string())
    };
    add(
        grid.vertices(bumpy_sphere).collect(),
        grid.triangles().collect(),
        1,
    )?;
    let corners = [(0.6, -3000.0), (0.4, 3000.0), (-6000.0, 100.0)];
    let corners = corners.map(|(x, y)| Point::new(x, y, -1.5)).to_vec();
    add(corners, vec![[0, 1, 2]], 2)?;
    let eye = Point::new(0.0, 0.0, -4.0);
    View::new(
        camera(eye, Point::new(0.0, 0.0, 0.0), 35.0, [1024, 1024]),
        shapes,
    )
}
