//! Polygons flattened onto two axes: turns and convexity, steps 2 to 4 of [`polygon`](super::polygon).

use crate::geometry::{Point, Vector};

/// A corner in the plane of step 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Flat {
    pub(super) u: f64,
    pub(super) v: f64,
}

/// Step 2: fills `flat`; `false` if the face is not finite.
pub(super) fn flatten(corners: &[u32], vertices: &[Point], flat: &mut Vec<Flat>) -> bool {
    let corner = |at: usize| vertices[corners[at % corners.len()] as usize];
    let normal = newell(corners.len(), |at| corner(at) - corner(0));
    if !normal.is_finite() {
        return false;
    }
    let axis = normal.largest_axis();
    let (mut u, mut v) = ((axis + 1) % 3, (axis + 2) % 3);
    if normal[axis] < 0.0 {
        std::mem::swap(&mut u, &mut v);
    }
    flat.clear();
    flat.extend((0..corners.len()).map(|at| Flat {
        u: corner(at)[u],
        v: corner(at)[v],
    }));
    (0..corners.len()).all(|at| corner(at).is_finite())
}

fn newell(count: usize, corner: impl Fn(usize) -> Vector) -> Vector {
    let (mut x, mut y, mut z) = (0.0, 0.0, 0.0);
    for at in 0..count {
        let (a, b) = (corner(at), corner(at + 1));
        x += (a.y - b.y) * (a.z + b.z);
        y += (a.z - b.z) * (a.x + b.x);
        z += (a.x - b.x) * (a.y + b.y);
    }
    Vector::new(x, y, z)
}

/// Step 3: positive if the way from `a` over `b` to `c` bends to the left.
pub(super) fn turn(a: Flat, b: Flat, c: Flat) -> f64 {
    (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u)
}

/// Step 4.
pub(super) fn is_convex(flat: &[Flat]) -> bool {
    let around = |at: usize| flat[at % flat.len()];
    (0..flat.len()).all(|at| turn(around(at), around(at + 1), around(at + 2)) >= 0.0)
        && goes_around_once(flat)
}

fn goes_around_once(flat: &[Flat]) -> bool {
    let edges = flat.iter().zip(flat.iter().cycle().skip(1));
    let upwards = edges
        .filter(|(a, b)| a != b)
        .map(|(a, b)| b.v > a.v || (b.v == a.v && b.u > a.u));
    let mut first = None;
    let mut last = None;
    let mut changes = 0;
    for up in upwards {
        changes += usize::from(last.is_some_and(|last| last != up));
        first.get_or_insert(up);
        last = Some(up);
    }
    changes + usize::from(first != last) == 2
}
