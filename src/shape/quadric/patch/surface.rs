//! u, v and the normal of a patch at the point where a ray meets it.

use super::Patch;
use crate::exact::{exponent_of, power_of_two};
use crate::geometry::{Ray, Vector};

/// A point of a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PatchPoint {
    /// pbrt-v4's parameters, from 0 to 1.
    pub(crate) uv: [f64; 2],
    /// The unit vector along dp/du x dp/dv; 0 where there is none.
    pub(crate) normal: Vector,
}

impl Patch {
    /// The point of the patch nearest to that of `ray` at `t`, of all points whose rulings meet the
    /// ray.
    pub(crate) fn point(&self, ray: &Ray, t: f64) -> PatchPoint {
        let from_origin = self.corners.map(|corner| corner - ray.origin);
        let size = scale_of(&from_origin);
        let [p00, p10, p01, p11] = from_origin.map(|v| v * (1.0 / size));
        let d = ray.direction * (1.0 / scale_of(&[ray.direction]));
        let target = ray.direction * (t / size);
        let (side, first, last) = (minus(p10, p00), minus(p01, p00), minus(p11, p10));
        let twist = minus(last, first);
        let (of_first, of_twist) = (first.cross(d), twist.cross(d));
        let c0 = p00.dot(of_first);
        let c1 = p00.dot(of_twist) + side.dot(of_first);
        let c2 = side.dot(of_twist);
        let root = (c1 * c1 - 4.0 * (c0 * c2)).max(0.0).sqrt();
        let q = -0.5 * (c1 + root.copysign(c1));
        let mut best = ([0.0; 2], f64::INFINITY);
        for u in [q / c2, c0 / q] {
            let u = if u.is_nan() { 0.5 } else { u.clamp(0.0, 1.0) };
            let (start, along) = (plus(p00, side, u), plus(first, twist, u));
            let way = minus(target, start);
            let v = way.dot(along) / along.dot(along);
            let v = if v.is_nan() { 0.0 } else { v.clamp(0.0, 1.0) };
            let off = minus(way, along * v);
            let distance = off.dot(off);
            if distance < best.1 {
                best = ([u, v], distance);
            }
        }
        let [u, v] = best.0;
        let along_u = plus(side, twist, v);
        let along_v = plus(first, twist, u);
        PatchPoint {
            uv: [u, v],
            normal: unit(along_u.cross(along_v)),
        }
    }

    /// The `t` at which `ray` comes nearest to the middle of the corners.
    pub(crate) fn nearest(&self, ray: &Ray) -> f64 {
        let [a, b, c, d] = self.corners.map(|corner| (corner - ray.origin) * 0.25);
        let middle = plus(plus(plus(a, b, 1.0), c, 1.0), d, 1.0);
        middle.dot(ray.direction) / ray.direction.dot(ray.direction)
    }
}

fn minus(a: Vector, b: Vector) -> Vector {
    Vector::new(a.x - b.x, a.y - b.y, a.z - b.z)
}

fn plus(a: Vector, b: Vector, factor: f64) -> Vector {
    Vector::new(a.x + b.x * factor, a.y + b.y * factor, a.z + b.z * factor)
}

/// A power of two near the largest component.
fn scale_of(vectors: &[Vector]) -> f64 {
    let largest = vectors.iter().fold(0.0f64, |max, v| max.max(v.largest()));
    power_of_two(exponent_of(largest.clamp(f64::MIN_POSITIVE, f64::MAX)))
}

/// The unit vector, without overflow or underflow; 0 for 0.
fn unit(v: Vector) -> Vector {
    match v.largest() {
        0.0 => Vector::default(),
        largest => Vector::new(v.x / largest, v.y / largest, v.z / largest).normalized(),
    }
}
