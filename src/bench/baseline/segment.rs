//! Segments of curves in the way of pbrt-v3: the ray in object space, and the nearest point of a
//! straight piece.

use super::ray32::Ray32;
use crate::shape::Segment;
use crate::shape::vector32::{cross, dot};
use std::array::from_fn;

/// The `t` at which `ray` hits `segment`.
pub(super) fn intersect(ray: &Ray32, segment: &Segment) -> Option<f32> {
    let object_from_world = segment.world_from_object.inverse().rows;
    let rows = object_from_world.map(|row| row.map(|entry| entry as f32));
    let apply = |v: [f32; 3]| rows.map(|row| dot([row[0], row[1], row[2]], v));
    let (moved, direction) = (apply(ray.origin), apply(ray.direction));
    let tips: [[f32; 3]; 2] = segment
        .ends
        .map(|end| from_fn(|k| end[k] as f32 - moved[k] - rows[k][3]));
    let axis: [f32; 3] = from_fn(|k| tips[1][k] - tips[0][k]);
    let tangents = segment.tangents.map(|v| v.to_array().map(|x| x as f32));
    let side = |end: usize| dot(cross(tips[end], direction), cross(direction, tangents[end]));
    let across = cross(direction, axis);
    let slant = dot(across, across);
    if slant == 0.0 || side(0) < 0.0 || side(1) > 0.0 {
        return None;
    }
    let w = (dot(cross(tips[0], direction), across) / slant).clamp(0.0, 1.0);
    let nearest: [f32; 3] = from_fn(|k| tips[0][k] + w * axis[k]);
    let [first, last] = segment.half_widths.map(|width| width as f32);
    let width = first + w * (last - first);
    let (off, square) = (cross(nearest, direction), dot(direction, direction));
    let t = dot(nearest, direction) / square;
    (t > 0.0 && dot(off, off) <= width * width * square).then_some(t)
}
