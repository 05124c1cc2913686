//! The test in `f32`, its answer as it comes.

use super::Sphere;
use super::cut::{Cut, Plane};
use crate::geometry::Vector;
use crate::shape::vector32::{cross, dot};

/// A sphere with the numbers that the test in `f32` uses, in units chosen by the caller.
pub(crate) struct SingleSphere<'a> {
    /// The adjugate of m, the linear part of M over a number s.
    adjugate: [[f32; 3]; 3],
    /// s det m, and that times the radius.
    determinant: f32,
    radius: f32,
    cut: Option<&'a Cut>,
}

impl SingleSphere<'_> {
    /// `sphere`, where one of its units is `units` of the ray's.
    pub(crate) fn new(sphere: &Sphere, units: f64) -> SingleSphere<'_> {
        let scale = sphere.scale();
        let m = &sphere.world_from_object;
        let [x, y, z] = [0, 1, 2].map(|j| Vector::from(m.column(j).map(|entry| entry / scale)));
        let rows = [y.cross(z), z.cross(x), x.cross(y)];
        let determinant = x.dot(rows[0]) * (scale * units);
        SingleSphere {
            adjugate: rows.map(|row| row.to_array().map(|entry| entry as f32)),
            determinant: determinant as f32,
            radius: (sphere.radius * determinant.abs()) as f32,
            cut: sphere.cut.as_ref(),
        }
    }

    /// The `t` at which a ray first meets what there is of the sphere; `origin` is relative to its centre.
    pub(crate) fn intersect(&self, origin: [f32; 3], direction: [f32; 3]) -> Option<f32> {
        let (o, d) = (self.apply(origin), self.apply(direction));
        let square_of_radius = self.radius * self.radius;
        let (a, b, c) = (dot(d, d), dot(o, d), dot(o, o) - square_of_radius);
        let moment = cross(o, d);
        let discriminant = square_of_radius * a - dot(moment, moment);
        if discriminant < 0.0 {
            return None;
        }
        let root = discriminant.sqrt();
        let (nearer, farther) =
            if b < 0.0 { (c / (root - b), (root - b) / a) } else { ((-b - root) / a, -c / (b + root)) };
        [nearer, farther].into_iter().find(|t| *t > 0.0 && self.is_there(o, d, *t))
    }

    fn is_there(&self, o: [f32; 3], d: [f32; 3], t: f32) -> bool {
        let Some(cut) = self.cut else { return true };
        let point: [f32; 3] = std::array::from_fn(|k| (o[k] + t * d[k]) * self.determinant.signum());
        let side = |plane: &Plane| {
            let offset = plane.offset as f32 * self.determinant.abs();
            dot(plane.normal.map(|component| component as f32), point).partial_cmp(&offset)
        };
        cut.holds(side) == Some(true)
    }

    fn apply(&self, v: [f32; 3]) -> [f32; 3] {
        self.adjugate.map(|row| dot(row, v))
    }
}
