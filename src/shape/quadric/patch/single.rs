//! The test of a patch in `f32`, without error bounds.

use crate::shape::vector32::{cross, dot};

/// The `t` at which a ray along `d` first meets the patch with these corners, which are relative to
/// its origin: p00, p10, p01 and p11 ("Cool Patches").
pub(crate) fn intersect_patch([p00, p10, p01, p11]: [[f32; 3]; 4], d: [f32; 3]) -> Option<f32> {
    let minus = |a: [f32; 3], b: [f32; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let (start, end) = (minus(p01, p00), minus(p11, p10));
    let side = minus(p10, p00);
    let c0 = dot(p00, cross(start, d));
    let at_one = dot(p10, cross(end, d));
    let c2 = dot(side, cross(minus(end, start), d));
    let c1 = at_one - c0 - c2;
    let discriminant = c1 * c1 - 4.0 * c0 * c2;
    if discriminant < 0.0 {
        return None;
    }
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    let mut first: Option<f32> = None;
    for u in [q / c2, c0 / q] {
        if !(0.0..=1.0).contains(&u) {
            continue;
        }
        let at = |from: [f32; 3], to: [f32; 3]| -> [f32; 3] {
            std::array::from_fn(|k| from[k] + u * (to[k] - from[k]))
        };
        let (a, r) = (at(p00, p10), at(start, end));
        let n = cross(r, d);
        let square = dot(n, n);
        let v = -dot(cross(a, d), n) / square;
        let t = -dot(cross(a, r), n) / square;
        let is_hit = (0.0..=1.0).contains(&v) && t > 0.0;
        if is_hit && first.is_none_or(|first| t < first) {
            first = Some(t);
        }
    }
    first
}
