//! Single-precision triangle test without error bounds.

use crate::shape::vector32::{cross, dot};

/// The `t` at which a ray along `direction` crosses the closed triangle with `corners` relative to
/// its origin, or `None`.
///
/// The signs of the three edge functions decide (Woop, Benthin, Wald, "Watertight Ray/Triangle
/// Intersection", 2013; here without the shear), and `t` is the mean of the corners' along the
/// largest axis of the direction, weighted by them.
#[inline]
pub(crate) fn intersect_single(
    corners: [[f32; 3]; 3],
    direction: [f32; 3],
    largest_axis: usize,
) -> Option<f32> {
    let [v0, v1, v2] = corners;
    let edges = [
        dot(direction, cross(v1, v2)),
        dot(direction, cross(v2, v0)),
        dot(direction, cross(v0, v1)),
    ];
    let inside = edges.iter().all(|edge| *edge >= 0.0) || edges.iter().all(|edge| *edge <= 0.0);
    let sum = edges[0] + edges[1] + edges[2];
    if !inside || sum == 0.0 {
        return None;
    }
    let along = |corner: [f32; 3]| corner[largest_axis] / direction[largest_axis];
    let t = (edges[0] * along(v0) + edges[1] * along(v1) + edges[2] * along(v2)) / sum;
    (t > 0.0).then_some(t)
}
