//! Single-precision quadric test without error bounds.

use super::cut::Plane;
use super::revolved::Equation;
use super::{Disk, Form, Quadric, Revolved};
use crate::geometry::Vector;
use crate::per_axis::per_axis;
use crate::shape::vector32::{cross, dot};
use std::cmp::Ordering;

/// A quadric with the numbers that the test uses, in units chosen by the caller.
pub(crate) struct SingleQuadric<'a> {
    /// The adjugate of m, the linear part of M over a number s.
    adjugate: [[f32; 3]; 3],
    /// s det m, and its absolute value times the radius.
    determinant: f32,
    radius: f32,
    quadric: &'a Quadric,
}

impl SingleQuadric<'_> {
    /// `quadric`, one unit of which is `units` of the ray's.
    pub(crate) fn new(quadric: &Quadric, units: f64) -> SingleQuadric<'_> {
        let scale = quadric.scale();
        let m = &quadric.world_from_object;
        let [x, y, z] = per_axis(|j| Vector::from(m.column(j).map(|entry| entry / scale)));
        let rows = [y.cross(z), z.cross(x), x.cross(y)];
        let determinant = x.dot(rows[0]) * (scale * units);
        SingleQuadric {
            adjugate: rows.map(|row| row.to_array().map(|entry| entry as f32)),
            determinant: determinant as f32,
            radius: (quadric.radius * determinant.abs()) as f32,
            quadric,
        }
    }

    /// The `t` at which a ray first meets the surface; `origin` is relative to the image of the
    /// origin of object space.
    pub(crate) fn intersect(&self, origin: [f32; 3], direction: [f32; 3]) -> Option<f32> {
        let (o, d) = (self.apply(origin), self.apply(direction));
        match &self.quadric.form {
            Form::Sphere(cut) => self.meet(o, d, |t| {
                cut.is_none_or(|cut| {
                    cut.holds(|plane| self.side(&self.point(o, d, t), plane)) == Some(true)
                })
            }),
            Form::Cylinder(cut) => self.meet([o[0], o[1], 0.0], [d[0], d[1], 0.0], |t| {
                cut.holds(|plane| self.side(&self.point(o, d, t), plane)) == Some(true)
            }),
            Form::Disk(disk) => self.cross(o, d, disk),
            Form::Revolved(revolved) => self.meet_revolved(o, d, revolved),
            Form::Patch => None,
        }
    }

    /// The first positive t at which the ray meets the part of a surface of revolution.
    fn meet_revolved(&self, mut o: [f32; 3], d: [f32; 3], revolved: &Revolved) -> Option<f32> {
        let determinant = self.determinant;
        let unscale = |p: [f32; 3]| p.map(|x| f64::from(x / determinant));
        let equation = Equation::of(revolved, self.quadric.radius);
        let whole = o;
        o[2] -= equation.base as f32 * determinant;
        let [f, g, h] = equation.over_across().map(|term| term as f32);
        let (g, h) = (g * determinant, h * (determinant * determinant));
        let across = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1];
        let moment = cross(o, d);
        let (dd, slope) = (across(d, d), d[2] * d[2]);
        let aside = d[1] * moment[0] - d[0] * moment[1];
        let (a, b) = (dd + f * slope, across(o, d) + (f * o[2] + g) * d[2]);
        let c = across(o, o) + (f * o[2] + 2.0 * g) * o[2] + h;
        let discriminant = (g * g - f * h) * slope
            - (moment[2] * moment[2] + f * across(moment, moment) + h * dd - 2.0 * g * aside);
        if discriminant < 0.0 {
            return None;
        }
        let q = -(b + discriminant.sqrt().copysign(b));
        let [one, other] = [q / a, c / q];
        let roots = if other < one {
            [other, one]
        } else {
            [one, other]
        };
        let point = |t: f32| std::array::from_fn(|k| whole[k] + t * d[k]);
        roots
            .into_iter()
            .find(|t| *t > 0.0 && t.is_finite() && revolved.holds_point(unscale(point(*t))))
    }

    /// The first positive t with |o + t d| = R that is within the part.
    fn meet(&self, o: [f32; 3], d: [f32; 3], is_there: impl Fn(f32) -> bool) -> Option<f32> {
        let square_of_radius = self.radius * self.radius;
        let (a, b, c) = (dot(d, d), dot(o, d), dot(o, o) - square_of_radius);
        let moment = cross(o, d);
        let discriminant = square_of_radius * a - dot(moment, moment);
        if discriminant < 0.0 {
            return None;
        }
        let root = discriminant.sqrt();
        let (nearer, farther) = if b < 0.0 {
            (c / (root - b), (root - b) / a)
        } else {
            ((-b - root) / a, -c / (b + root))
        };
        [nearer, farther]
            .into_iter()
            .find(|t| *t > 0.0 && is_there(*t))
    }

    /// The `t` at which the ray crosses the plane of `disk`, if it is positive and within the disk.
    fn cross(&self, o: [f32; 3], d: [f32; 3], disk: &Disk) -> Option<f32> {
        let t = (disk.height as f32 * self.determinant - o[2]) / d[2];
        let point = self.point(o, d, t);
        let distance = point[0] * point[0] + point[1] * point[1];
        let from_axis = |limit: f64| {
            let limit = limit as f32 * self.determinant;
            distance.partial_cmp(&(limit * limit))
        };
        let is_there = disk.holds(self.quadric.radius, from_axis, |plane| {
            self.side(&point, plane)
        });
        (t > 0.0 && is_there == Some(true)).then_some(t)
    }

    /// The point at `t` in object space, times the absolute determinant.
    fn point(&self, o: [f32; 3], d: [f32; 3], t: f32) -> [f32; 3] {
        std::array::from_fn(|k| (o[k] + t * d[k]) * self.determinant.signum())
    }

    fn side(&self, point: &[f32; 3], plane: &Plane) -> Option<Ordering> {
        let offset = plane.offset as f32 * self.determinant.abs();
        dot(plane.normal.map(|component| component as f32), *point).partial_cmp(&offset)
    }

    fn apply(&self, v: [f32; 3]) -> [f32; 3] {
        self.adjugate.map(|row| dot(row, v))
    }
}
