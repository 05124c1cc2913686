//! Triangles that `f32` cannot place on the film: very large ones, and those that cross the plane
//! of the eye. Homogeneous edge functions need no clipping (Olano and Greer, 1997).

use super::projection::Projection;
use super::tile::{HEIGHT, Linear, Shape, WIDTH};

/// Numbers of the plane function `[0] * x + [1] * y + [2]` on the film.
type Plane = [f64; 3];

/// Three edges, at least 0 within, and the nearness.
#[derive(Debug, Clone)]
pub(super) struct Large {
    edges: [Plane; 3],
    nearness: Plane,
    /// The least and the greatest nearness of the corners; no limit if one is behind the eye.
    range: [f32; 2],
}

impl Large {
    /// `None` if no ray can hit it.
    pub(super) fn new(projection: &Projection, points: [[f32; 3]; 3]) -> Option<Large> {
        let corners = points.map(|point| projection.homogeneous(point));
        let depths = corners.map(|(_, depth)| depth);
        if depths.iter().all(|&depth| depth <= 0.0) {
            return None;
        }
        let places = corners.map(|(place, _)| place.to_array());
        let edges = [
            cross(places[1], places[2]),
            cross(places[2], places[0]),
            cross(places[0], places[1]),
        ];
        let [a, b, c] = [0, 1, 2].map(|k| places[0][k] * edges[0][k]);
        let determinant = a + b + c;
        if determinant == 0.0 || !determinant.is_finite() {
            return None;
        }
        let edges = edges.map(|edge| edge.map(|number| number / determinant));
        let weights = if projection.is_perspective {
            [1.0; 3]
        } else {
            depths.map(|depth| -depth)
        };
        let nearness = [0, 1, 2].map(|k| (0..3).map(|i| edges[i][k] * weights[i]).sum());
        let range = if depths.iter().all(|&depth| depth > 0.0) {
            let [low, high] = [f64::min, f64::max]
                .map(|choose| depths.into_iter().reduce(choose).expect("three corners") as f32);
            if projection.is_perspective {
                [1.0 / high, 1.0 / low]
            } else {
                [-high, -low]
            }
        } else {
            [projection.background(), f32::INFINITY]
        };
        Some(Large {
            edges,
            nearness,
            range,
        })
    }

    /// The triangle relative to the first pixel of a tile; `None` if it is certainly outside.
    pub(super) fn in_tile(&self, x: usize, y: usize) -> Option<Shape> {
        let (x, y) = (x as f64, y as f64);
        let moved = |[a, b, c]: Plane| [a, b, a * x + b * y + c];
        let edges = self.edges.map(|edge| {
            let [a, b, c] = moved(edge);
            let scale = 1.0 / (a.abs() + b.abs()).max(f64::MIN_POSITIVE);
            [a * scale, b * scale, c * scale]
        });
        let (right, bottom) = (WIDTH as f64, HEIGHT as f64);
        let is_outside = |[a, b, c]: Plane| c + a.max(0.0) * right + b.max(0.0) * bottom < 0.0;
        if edges.iter().any(|&edge| is_outside(edge)) {
            return None;
        }
        let narrow = |[a, b, c]: Plane| Linear {
            across: a as f32,
            down: b as f32,
            first: c as f32,
        };
        Some(Shape {
            edges: edges.map(narrow),
            nearness: narrow(moved(self.nearness)),
            range: self.range,
        })
    }
}

fn cross([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> Plane {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}
