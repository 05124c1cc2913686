//! A long thin terrain, seen along its length from just above.

use super::place::camera;
use crate::Result;
use crate::grid::Grid;
use crate::view::View;
use feimos::geometry::{Matrix, Point};
use feimos::shape::Geometry as SceneGeometry;

const LENGTH: f64 = 2000.0;
const WIDTH: f64 = 40.0;

/// A million triangles; a ray that misses the first hill runs close to all the others.
pub(super) fn view() -> Result<View> {
    let mut shapes = SceneGeometry::default();
    let grid = Grid {
        columns: 100,
        rows: 5000,
    };
    let (vertices, triangles) = (grid.vertices(place).collect(), grid.triangles().collect());
    shapes
        .add_mesh(vertices, triangles, &Matrix::IDENTITY, 1)
        .map_err(|error| error.to_string())?;
    let eye = Point::new(0.0, 2.4, -10.0);
    View::new(
        camera(eye, Point::new(0.0, 2.0, 100.0), 30.0, [1920, 1080]),
        shapes,
    )
}

fn place(across: f64, along: f64) -> Point {
    let (x, z) = (WIDTH * (across - 0.5), LENGTH * along);
    let waves = [(1.2, 0.11, 0.05), (0.5, 0.9, 0.31), (0.15, 2.3, 1.9)];
    let height =
        |(height, in_x, in_z): (f64, f64, f64)| height * (in_x * x + 1.0).sin() * (in_z * z).cos();
    Point::new(x, waves.map(height).iter().sum(), z)
}
