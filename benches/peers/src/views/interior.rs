//! A hall with columns and things on its floor, seen from its middle.

use super::place::camera;
use crate::Result;
use crate::grid::{Grid, bumpy_sphere};
use crate::view::View;
use feimos::geometry::{Matrix, Point};
use feimos::shape::Geometry as SceneGeometry;

/// Half of the hall's length and width.
const HALF: f64 = 10.0;
const HEIGHT: f64 = 4.0;

/// A million triangles on all sides of the eye; floor and ceiling are two triangles each, which cross its plane.
pub(super) fn view() -> Result<View> {
    let mut hall = Hall::default();
    let plain = Grid {
        columns: 1,
        rows: 1,
    };
    for height in [0.0, HEIGHT] {
        hall.add(plain, &Matrix::IDENTITY, |u, v| {
            Point::new(HALF * (2.0 * u - 1.0), height, HALF * (2.0 * v - 1.0))
        })?;
    }
    for side in [-HALF, HALF] {
        let wall = Grid {
            columns: 250,
            rows: 100,
        };
        hall.add(wall, &Matrix::IDENTITY, |u, v| {
            relief(u, v, |along, out| Point::new(along, v * HEIGHT, side - out))
        })?;
        hall.add(wall, &Matrix::IDENTITY, |u, v| {
            relief(u, v, |along, out| Point::new(side - out, v * HEIGHT, along))
        })?;
    }
    for (x, z) in places() {
        hall.add(
            Grid {
                columns: 48,
                rows: 100,
            },
            &Matrix::translate([x, 0.0, z]),
            column,
        )?;
        let lying =
            Matrix::translate([x + 1.3, 0.35, z - 0.7]).times(&Matrix::scale([0.5, 0.35, 0.5]));
        hall.add(
            Grid {
                columns: 96,
                rows: 64,
            },
            &lying,
            bumpy_sphere,
        )?;
    }
    let (eye, look) = (Point::new(0.2, 1.7, -0.4), Point::new(3.0, 1.4, 8.0));
    View::new(camera(eye, look, 75.0, [1280, 720]), hall.shapes)
}

#[derive(Default)]
struct Hall {
    shapes: SceneGeometry,
    meshes: u32,
}

impl Hall {
    fn add(
        &mut self,
        grid: Grid,
        world_from_object: &Matrix,
        place: impl Fn(f64, f64) -> Point,
    ) -> Result<()> {
        self.meshes += 1;
        let (vertices, triangles) = (grid.vertices(place).collect(), grid.triangles().collect());
        let added = self
            .shapes
            .add_mesh(vertices, triangles, world_from_object, self.meshes);
        added.map_err(|error| error.to_string())?;
        Ok(())
    }
}

/// A point of a wall: `place` has its place along the wall and how far it stands out.
fn relief(u: f64, v: f64, place: impl Fn(f64, f64) -> Point) -> Point {
    let out = 0.06 * ((60.0 * u).sin() * (24.0 * v).sin()).powi(2);
    place(HALF * (2.0 * u - 1.0), out)
}

/// Around the hall in a square grid, none in the middle.
fn places() -> impl Iterator<Item = (f64, f64)> {
    let line = || [-7.5, -4.5, -1.5, 1.5, 4.5, 7.5];
    line().into_iter().flat_map(move |x| line().map(|z| (x, z)))
}

/// A fluted column around the axis.
fn column(u: f64, v: f64) -> Point {
    let angle = std::f64::consts::TAU * u;
    let radius = 0.25 + 0.02 * (12.0 * angle).cos() + 0.1 * (2.0 * v - 1.0).powi(8);
    Point::new(radius * angle.cos(), HEIGHT * v, radius * angle.sin())
}
