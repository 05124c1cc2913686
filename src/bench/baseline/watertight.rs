//! "Watertight ray/triangle intersection" (Woop, Benthin and Wald, 2013).

use super::ray32::{Corners, Ray32, minus};

/// As in the paper: edge functions of the corners, sheared into the ray's own space, so that
/// triangles with a common edge agree on it. If one is 0, all are computed in `f64`.
#[inline]
pub(super) fn intersect(ray: &Ray32, corners: &Corners) -> Option<f32> {
    let [x, y, z] = ray.axes;
    let [shear_x, shear_y, shear_z] = ray.shear;
    let [a, b, c] = corners.map(|corner| {
        let corner = minus(corner, ray.origin);
        [
            corner[x] + shear_x * corner[z],
            corner[y] + shear_y * corner[z],
            shear_z * corner[z],
        ]
    });
    let edges = match [edge(b, c), edge(c, a), edge(a, b)] {
        edges if edges.contains(&0.0) => [edge_in_f64(b, c), edge_in_f64(c, a), edge_in_f64(a, b)],
        edges => edges,
    };
    let is_outside = edges.iter().any(|e| *e < 0.0) && edges.iter().any(|e| *e > 0.0);
    let determinant = edges[0] + edges[1] + edges[2];
    if is_outside || determinant == 0.0 {
        return None;
    }
    let t = (edges[0] * a[2] + edges[1] * b[2] + edges[2] * c[2]) / determinant;
    (t > 0.0).then_some(t)
}

fn edge(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[1] - a[1] * b[0]
}

#[cold]
fn edge_in_f64(a: [f32; 3], b: [f32; 3]) -> f32 {
    (f64::from(a[0]) * f64::from(b[1]) - f64::from(a[1]) * f64::from(b[0])) as f32
}
