//! Normals of segments, and pbrt's parameters on them.

use super::Segment;
use crate::geometry::{Matrix, Ray, Vector};
use crate::per_axis::per_axis;
use std::f64::consts::PI;

/// Where a ray meets a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SegmentPlace {
    /// How far along the axis, from 0 to 1.
    pub(crate) along: f64,
    /// How far across it, from 0 to 1: pbrt's v.
    pub(crate) across: f64,
}

impl Segment {
    /// The place where `ray` meets it, or the nearest one.
    pub(crate) fn place_at(&self, ray: &Ray) -> SegmentPlace {
        let (start, axis, d) = self.in_object_space(&self.world_from_object.inverse(), ray);
        let across = d.cross(axis);
        let along = start.cross(d).dot(across) / across.dot(across);
        // Also where that is not a number.
        let along = if along > 0.0 { along.min(1.0) } else { 0.0 };
        let nearest = Vector::from(per_axis(|k| start[k] + along * axis[k]));
        let off = nearest.cross(d);
        let distance = (off.dot(off) / d.dot(d)).sqrt();
        let [first, last] = self.half_widths;
        let half = (1.0 - along) * first + along * last;
        let part = if half > 0.0 {
            (distance / half).min(1.0)
        } else {
            0.0
        };
        let is_beyond = start.cross(axis).dot(d) > 0.0;
        let side = if is_beyond { 0.5 } else { -0.5 };
        SegmentPlace {
            along,
            across: 0.5 + side * part,
        }
    }

    /// The unit normal in the world where `ray` meets it: across the axis, and on the far side of
    /// the strip, as in pbrt.
    pub fn normal(&self, ray: &Ray) -> Vector {
        let inverse = self.world_from_object.inverse();
        let (_, axis, d) = self.in_object_space(&inverse, ray);
        normal_in_world(&inverse, axis.cross(d.cross(axis)))
    }

    /// The same on a curve that is shaded like a cylinder: at pbrt's v, `across`, it is turned by
    /// up to 90 degrees about the axis.
    pub(crate) fn round_normal(&self, ray: &Ray, across: f64) -> Vector {
        let inverse = self.world_from_object.inverse();
        let (_, axis, d) = self.in_object_space(&inverse, ray);
        let side = d.cross(axis);
        let angle = (across - 0.5) * PI;
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let (front, side) = (unit(axis.cross(side)), unit(side));
        normal_in_world(
            &inverse,
            Vector::from(per_axis(|k| front[k] * cosine + side[k] * sine)),
        )
    }

    /// From the origin of the ray to the start, the axis, and the direction of the ray, given the
    /// `inverse` of the matrix, which is exact and therefore slow.
    fn in_object_space(&self, inverse: &Matrix, ray: &Ray) -> (Vector, Vector, Vector) {
        let [a, b] = self.ends;
        let start = self.world_from_object.apply(a) - ray.origin;
        let turned = |v: Vector| {
            Vector::from(
                inverse
                    .rows
                    .map(|row| row[0] * v.x + row[1] * v.y + row[2] * v.z),
            )
        };
        (turned(start), b - a, turned(ray.direction))
    }
}

/// A normal in object space, mapped to the world by the transposed `inverse`.
fn normal_in_world(inverse: &Matrix, normal: Vector) -> Vector {
    let component = |k: usize| Vector::from(inverse.column(k)).dot(normal);
    unit(Vector::new(component(0), component(1), component(2)))
}

/// `v` with length 1; 0 stays 0.
fn unit(v: Vector) -> Vector {
    match v.largest() {
        0.0 => Vector::default(),
        largest => Vector::new(v.x / largest, v.y / largest, v.z / largest).normalized(),
    }
}
