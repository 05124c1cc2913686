//! Meshes whose vertices stand in rows and columns.

use feimos::geometry::Point;

/// `columns` by `rows` quads, two triangles each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Grid {
    pub(crate) columns: u32,
    pub(crate) rows: u32,
}

impl Grid {
    /// A grid twice as long as high with about `triangles` triangles, at least 4.
    pub(crate) fn of_triangles(triangles: u64) -> Grid {
        let rows = ((triangles as f64 / 4.0).sqrt().round() as u32).max(1);
        Grid {
            columns: 2 * rows,
            rows,
        }
    }

    pub(crate) fn triangle_count(self) -> u64 {
        2 * u64::from(self.columns) * u64::from(self.rows)
    }

    pub(crate) fn vertex_count(self) -> u64 {
        (u64::from(self.columns) + 1) * (u64::from(self.rows) + 1)
    }

    /// The vertices: `place` says where one lies from its place along a row and along a column, from 0 to 1.
    pub(crate) fn vertices(self, place: impl Fn(f64, f64) -> Point) -> impl Iterator<Item = Point> {
        let Grid { columns, rows } = self;
        let share = |i: u32, of: u32| f64::from(i) / f64::from(of);
        let places = (0..=rows).flat_map(move |row| (0..=columns).map(move |column| (row, column)));
        places.map(move |(row, column)| place(share(column, columns), share(row, rows)))
    }

    /// The corners of the triangles, by place among the vertices.
    pub(crate) fn triangles(self) -> impl Iterator<Item = [u32; 3]> {
        let Grid { columns, rows } = self;
        let places = (0..rows)
            .flat_map(move |row| (0..columns).map(move |column| row * (columns + 1) + column));
        places.flat_map(move |first| {
            let above = first + columns + 1;
            [[first, first + 1, above + 1], [first, above + 1, above]]
        })
    }
}

/// A sphere of radius 1 with bumps of several sizes, `u` around and `v` from pole to pole.
pub(crate) fn bumpy_sphere(u: f64, v: f64) -> Point {
    use std::f64::consts::{PI, TAU};
    let (longitude, latitude) = (TAU * u, PI * v);
    let bumps = [(3.0, 0.08), (11.0, 0.03), (41.0, 0.01), (149.0, 0.003)];
    let height = |(frequency, height): (f64, f64)| {
        height * (frequency * latitude).sin() * (frequency * longitude).cos() * latitude.sin()
    };
    let radius = 1.0 + bumps.map(height).iter().sum::<f64>();
    let across = radius * latitude.sin();
    Point::new(
        across * longitude.cos(),
        radius * latitude.cos(),
        across * longitude.sin(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_what_comes_out() {
        let grid = Grid::of_triangles(100);
        assert_eq!(
            grid,
            Grid {
                columns: 10,
                rows: 5
            }
        );
        assert_eq!(
            grid.vertices(bumpy_sphere).count() as u64,
            grid.vertex_count()
        );
        assert_eq!(grid.triangles().count() as u64, grid.triangle_count());
        assert!(
            grid.triangles()
                .flatten()
                .all(|corner| u64::from(corner) < grid.vertex_count())
        );
    }
}
