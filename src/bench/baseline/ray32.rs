//! Rays and triangles in `f32`.

use crate::geometry::Ray;

/// The corners of a triangle.
pub(super) type Corners = [[f32; 3]; 3];

/// A rounded ray, with the precomputed values of the watertight test.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray32 {
    pub(super) origin: [f32; 3],
    pub(super) direction: [f32; 3],
    /// The axes, ordered so that the largest component of the direction comes last.
    pub(super) axes: [usize; 3],
    /// The shear that takes the direction to (0, 0, 1).
    pub(super) shear: [f32; 3],
}

impl Ray32 {
    pub(super) fn new(ray: &Ray) -> Ray32 {
        let direction = ray.direction.to_array().map(|x| x as f32);
        let last = (0..3)
            .max_by(|a, b| direction[*a].abs().total_cmp(&direction[*b].abs()))
            .unwrap_or(2);
        let axes = [(last + 1) % 3, (last + 2) % 3, last];
        let [x, y, z] = axes.map(|axis| direction[axis]);
        Ray32 {
            origin: ray.origin.to_array().map(|x| x as f32),
            direction,
            axes,
            shear: [-x / z, -y / z, 1.0 / z],
        }
    }
}

pub(super) fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
