//! Dices NURBS surfaces into triangles, as pbrt-v3 does (rule R8).

mod direction;
#[cfg(test)]
mod tests;

pub use direction::{Direction, Homogeneous, MOST_ORDER, Mistake};

use super::grid::grid_triangles;
use super::{CornerWants, TriangleMesh, of_corners};
use crate::geometry::{Point, Vector};
use crate::shape::CornerUv;

/// Vertices along each direction of a diced surface.
pub const DICED: usize = 30;

/// A surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Nurbs {
    /// Along u.
    pub u: Direction,
    /// Along v.
    pub v: Direction,
    /// The control points in rows along u, one row after the other.
    pub control: Vec<Homogeneous>,
}

impl Nurbs {
    /// The triangles of a grid of [`DICED`] by [`DICED`] vertices at even steps of u and v. Vertex
    /// normals are unit vectors along dp/du x dp/dv.
    ///
    /// # Panics
    /// The number of control points is not the product of the counts.
    pub fn diced(&self, wants: CornerWants) -> TriangleMesh {
        assert_eq!(self.control.len(), self.u.count() * self.v.count());
        let (us, vs) = (self.u.steps(DICED), self.v.steps(DICED));
        let samples = vs.iter().flat_map(|v| us.iter().map(|u| self.at(*u, *v)));
        let (vertices, normals): (Vec<Point>, Vec<[f32; 3]>) = samples
            .map(|(point, normal)| (point, normal.to_array().map(|x| x as f32)))
            .unzip();
        let triangles = grid_triangles(DICED as u32, DICED as u32);
        let uv = |vertex: u32| {
            let vertex = vertex as usize;
            [us[vertex % DICED] as f32, vs[vertex / DICED] as f32]
        };
        let uv = |corners: &[u32; 3]| -> CornerUv { corners.map(uv) };
        TriangleMesh {
            vertices,
            uv: wants.uv.then(|| triangles.iter().map(uv).collect()),
            normals: wants.normals.then(|| of_corners(&triangles, &normals)),
            triangles,
        }
    }

    /// The point at `u` and `v`, and the unit normal along dp/du x dp/dv.
    fn at(&self, u: f64, v: f64) -> (Point, Vector) {
        let (column, row) = (self.u.span_of(u), self.v.span_of(v));
        let control = |x: usize, y: usize| self.control[y * self.u.count() + x];
        let along_v = |x: usize| self.v.evaluate(row, v, |y| control(x, y)).0;
        let along_u = |y: usize| self.u.evaluate(column, u, |x| control(x, y)).0;
        let (point, by_u) = self.u.evaluate(column, u, along_v);
        let (of_v, by_v) = self.v.evaluate(row, v, along_u);
        let [x, y, z, w] = point;
        let normal = derivative(point, by_u).cross(derivative(of_v, by_v));
        (Point::new(x / w, y / w, z / w), normal.normalized())
    }
}

/// The derivative of a point from that of its homogeneous coordinates.
fn derivative(point: Homogeneous, change: Homogeneous) -> Vector {
    let w = point[3];
    let component = |k: usize| change[k] / w - point[k] * change[3] / (w * w);
    Vector::new(component(0), component(1), component(2))
}
