//! Quadrics in the usual way: transforms the ray to object space and solves a quadratic equation.

use super::ray32::{Ray32, minus};
use crate::shape::vector32::dot;
use crate::shape::{Cut, Form, Quadric, Revolved, Sector, intersect_patch};
use std::f32::consts::TAU;

/// How a quadratic equation is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quadratic {
    /// `(-b -+ sqrt(b^2 - 4ac)) / 2a`.
    Textbook,
    /// As in pbrt-v3 (`efloat.h`): the discriminant in `f64`, and the root that would cancel from
    /// the other one.
    Pbrt,
}

impl Quadratic {
    /// The roots of `a t^2 + b t + c`, the smaller one first.
    fn roots(self, a: f32, b: f32, c: f32) -> Option<[f32; 2]> {
        let [one, other] = match self {
            Quadratic::Textbook => {
                let discriminant = b * b - 4.0 * a * c;
                if discriminant < 0.0 {
                    return None;
                }
                let root = discriminant.sqrt();
                [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]
            }
            Quadratic::Pbrt => {
                let discriminant = f64::from(b) * f64::from(b) - 4.0 * f64::from(a) * f64::from(c);
                if discriminant < 0.0 {
                    return None;
                }
                let root = discriminant.sqrt() as f32;
                let q = if b < 0.0 {
                    -0.5 * (b - root)
                } else {
                    -0.5 * (b + root)
                };
                [q / a, c / q]
            }
        };
        Some(if other < one {
            [other, one]
        } else {
            [one, other]
        })
    }
}

/// A quadric in `f32`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quadric32 {
    /// The columns of a patch are its corners.
    object_from_world: [[f32; 4]; 3],
    radius: f32,
    form: Form,
}

impl Quadric32 {
    pub(super) fn new(quadric: &Quadric) -> Quadric32 {
        let object_from_world = match quadric.form {
            Form::Patch => quadric.world_from_object.rows,
            _ => quadric.world_from_object.inverse().rows,
        };
        Quadric32 {
            object_from_world: object_from_world.map(|row| row.map(|entry| entry as f32)),
            radius: quadric.radius as f32,
            form: quadric.form,
        }
    }

    /// The `t` at which `ray` first hits the surface.
    pub(super) fn intersect(&self, ray: &Ray32, quadratic: Quadratic) -> Option<f32> {
        if self.form == Form::Patch {
            let corner = |k: usize| self.object_from_world.map(|row| row[k]);
            let corners = [0, 1, 2, 3].map(|k| minus(corner(k), ray.origin));
            return intersect_patch(corners, ray.direction);
        }
        let apply = |v: [f32; 3]| {
            self.object_from_world
                .map(|row| dot([row[0], row[1], row[2]], v))
        };
        let moved = apply(ray.origin);
        let o: [f32; 3] = std::array::from_fn(|k| moved[k] + self.object_from_world[k][3]);
        let d = apply(ray.direction);
        let point = |t: f32| -> [f32; 3] { std::array::from_fn(|k| o[k] + t * d[k]) };
        match &self.form {
            Form::Disk(disk) => {
                let t = (disk.height as f32 - o[2]) / d[2];
                let [x, y, _] = point(t);
                let square = x * x + y * y;
                let (inner, outer) = (disk.inner_radius as f32, self.radius);
                let is_kept = square <= outer * outer
                    && square >= inner * inner
                    && is_within(&disk.sector, x, y);
                (t > 0.0 && is_kept).then_some(t)
            }
            Form::Sphere(cut) => self.hit(o, d, quadratic, |t| {
                cut.is_none_or(|cut| is_kept_by(&cut, point(t)))
            }),
            Form::Cylinder(cut) => {
                let flat = |[x, y, _]: [f32; 3]| [x, y, 0.0];
                self.hit(flat(o), flat(d), quadratic, |t| is_kept_by(cut, point(t)))
            }
            Form::Revolved(revolved) => {
                let [a, b, c] = equation(revolved, self.radius, o, d);
                let roots = quadratic.roots(a, b, c)?;
                let is_kept = |t: f32| revolved.holds_point(point(t).map(f64::from));
                roots.into_iter().find(|t| *t > 0.0 && is_kept(*t))
            }
            Form::Patch => None,
        }
    }

    /// The first positive `t` with |o + t d| = r that `is_kept`.
    fn hit(
        &self,
        o: [f32; 3],
        d: [f32; 3],
        quadratic: Quadratic,
        is_kept: impl Fn(f32) -> bool,
    ) -> Option<f32> {
        let roots = quadratic.roots(
            dot(d, d),
            2.0 * dot(o, d),
            dot(o, o) - self.radius * self.radius,
        )?;
        roots.into_iter().find(|t| *t > 0.0 && is_kept(*t))
    }
}

/// pbrt-v3's coefficients of t^2, t and 1 for a cone, a paraboloid or a hyperboloid.
fn equation(revolved: &Revolved, radius: f32, o: [f32; 3], d: [f32; 3]) -> [f32; 3] {
    let across = |p: [f32; 3], q: [f32; 3]| p[0] * q[0] + p[1] * q[1];
    let [_, top] = revolved.ends().map(|z| z as f32);
    match revolved {
        Revolved::Cone(_) => {
            let k = (radius / top) * (radius / top);
            let z = o[2] - top;
            [
                across(d, d) - k * d[2] * d[2],
                2.0 * (across(d, o) - k * d[2] * z),
                across(o, o) - k * z * z,
            ]
        }
        Revolved::Paraboloid(_) => {
            let k = top / (radius * radius);
            [
                k * across(d, d),
                2.0 * k * across(d, o) - d[2],
                k * across(o, o) - o[2],
            ]
        }
        Revolved::Hyperboloid(hyperboloid) => {
            let (a, c) = (hyperboloid.across as f32, hyperboloid.along as f32);
            [
                a * across(d, d) - c * d[2] * d[2],
                2.0 * (a * across(d, o) - c * d[2] * o[2]),
                a * across(o, o) - c * o[2] * o[2] - 1.0,
            ]
        }
    }
}

fn is_kept_by(cut: &Cut, [x, y, z]: [f32; 3]) -> bool {
    z >= cut.z_min as f32 && z <= cut.z_max as f32 && is_within(&cut.sector, x, y)
}

fn is_within(sector: &Option<Sector>, x: f32, y: f32) -> bool {
    sector.is_none_or(|sector| {
        let angle = y.atan2(x);
        let angle = if angle < 0.0 { angle + TAU } else { angle };
        angle <= sector.degrees.to_radians() as f32
    })
}
