//! Faces to triangles (rule E3), by a procedure that is fixed for ever, since primitive numbers depend on it.
//!
//! A face of n corners always gives n - 2 triangles, degenerate ones among them.
//!
//! 1. A face of 3 or 4 corners is (0,1,2), (0,2,3).
//! 2. For more corners, all arithmetic is on the object-space `f64` corners, operation by operation as written.
//!    The normal is Newell's sum over consecutive corners p, q: x of `(p.y - q.y) * (p.z + q.z)`, y and z in turn.
//!    The face is projected along the axis of the normal's largest absolute component (the lowest of equal
//!    ones); for x, y, z the plane's coordinates are (y, z), (z, x), (x, y). Where the component is
//!    negative, the second coordinate is negated, so that the face always turns to the left.
//! 3. The turn at b between a and c is the sign of `(b - a) x (c - a)`, which is
//!    `(b0 - a0) * (c1 - a1) - (b1 - a1) * (c0 - a0)`.
//! 4. The face is convex where no corner turns to the right and the first coordinate, going round, changes its
//!    direction at most twice. A convex face is its fan (0,1,2), (0,2,3), ...; so is one with a corner or a normal
//!    that is not finite, or whose normal is 0.
//! 5. Any other face loses ears. Of the corners that remain, in their order, corner b between its neighbours a and c is
//!    an ear where it turns to the left and no other remaining corner lies in the closed triangle a, b, c, save
//!    corners in the same place as a, b or c. The search begins at corner 0, and after an ear was cut off at the
//!    corner that followed it, going round. The triangle is (a, b, c) in the order of the face. Where a whole round
//!    finds no ear (the outline crosses itself), the corner at which the search began is cut off all the same. The
//!    last three corners are the last triangle, in their order.

use crate::geometry::Point;

/// Corners of a face that is not convex, at most: cutting ears takes the square of the number.
pub(super) const MAX_CONCAVE: usize = 10_000;

/// The face is not convex and has more than [`MAX_CONCAVE`] corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TooManyCorners;

/// Appends the triangles of the face with these corners, given as indices of `vertices`.
pub(super) fn triangulate(
    corners: &[u32],
    vertices: &[Point],
    triangles: &mut [[u32; 3]],
) -> Result<(), TooManyCorners> {
    debug_assert_eq!(triangles.len(), corners.len() - 2);
    let outline = project(corners.iter().map(|corner| vertices[*corner as usize]));
    match outline.filter(|outline| !is_convex(outline)) {
        None => {
            for (k, triangle) in triangles.iter_mut().enumerate() {
                *triangle = [corners[0], corners[k + 1], corners[k + 2]];
            }
        }
        Some(outline) if outline.len() > MAX_CONCAVE => return Err(TooManyCorners),
        Some(outline) => {
            for (triangle, ear) in triangles.iter_mut().zip(cut_ears(&outline)) {
                *triangle = ear.map(|corner| corners[corner]);
            }
        }
    }
    Ok(())
}

/// Step 2; `None` where the face has no usable normal.
fn project(corners: impl Iterator<Item = Point> + Clone) -> Option<Vec<[f64; 2]>> {
    let mut normal = [0.0; 3];
    let following = corners.clone().cycle().skip(1);
    for (p, q) in corners.clone().zip(following) {
        for (k, sum) in normal.iter_mut().enumerate() {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            *sum += (p[i] - q[i]) * (p[j] + q[j]);
        }
    }
    let [x, y, z] = normal.map(f64::abs);
    let largest = x.max(y).max(z);
    let usable = [x, y, z].iter().all(|component| component.is_finite()) && largest > 0.0;
    if !usable || !corners.clone().all(Point::is_finite) {
        return None;
    }
    let axis = if x == largest {
        0
    } else if y == largest {
        1
    } else {
        2
    };
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let sign = if normal[axis] < 0.0 { -1.0 } else { 1.0 };
    Some(corners.map(|corner| [corner[i], sign * corner[j]]).collect())
}

/// Step 3: positive where the way from a over b to c turns to the left.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Step 4.
fn is_convex(outline: &[[f64; 2]]) -> bool {
    let count = outline.len();
    let corner = |k: usize| outline[k % count];
    let turns_left = (0..count).all(|k| turn(corner(k), corner(k + 1), corner(k + 2)) >= 0.0);
    let steps = (0..count).map(|k| corner(k + 1)[0] - corner(k)[0]).filter(|step| *step != 0.0);
    let steps: Vec<bool> = steps.map(|step| step > 0.0).collect();
    let changes = (0..steps.len()).filter(|k| steps[*k] != steps[(k + 1) % steps.len()]).count();
    turns_left && changes <= 2
}

/// Step 5: the triangles as places in the outline.
fn cut_ears(outline: &[[f64; 2]]) -> Vec<[usize; 3]> {
    let mut ring = Ring::new(outline);
    let mut ears = Vec::with_capacity(outline.len() - 2);
    let mut start = 0;
    while ring.len > 3 {
        let mut corner = start;
        let mut tried = 0;
        while tried < ring.len && !ring.is_ear(corner) {
            corner = ring.next[corner];
            tried += 1;
        }
        // After a whole round `corner` is `start` again.
        ears.push([ring.previous[corner], corner, ring.next[corner]]);
        start = ring.next[corner];
        ring.remove(corner);
    }
    let mut last = ring.remaining();
    last.sort_unstable();
    ears.push([last[0], last[1], last[2]]);
    ears
}

/// The corners that remain, each knowing its neighbours.
struct Ring<'a> {
    outline: &'a [[f64; 2]],
    previous: Vec<usize>,
    next: Vec<usize>,
    some: usize,
    len: usize,
}

impl Ring<'_> {
    fn new(outline: &[[f64; 2]]) -> Ring<'_> {
        let len = outline.len();
        let previous = (0..len).map(|k| (k + len - 1) % len).collect();
        let next = (0..len).map(|k| (k + 1) % len).collect();
        Ring { outline, previous, next, some: 0, len }
    }

    fn is_ear(&self, corner: usize) -> bool {
        let (before, after) = (self.previous[corner], self.next[corner]);
        let [a, b, c] = [before, corner, after].map(|k| self.outline[k]);
        if turn(a, b, c) <= 0.0 {
            return false;
        }
        let inside = |p: [f64; 2]| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        let mut other = self.next[after];
        while other != before {
            let p = self.outline[other];
            if inside(p) && p != a && p != b && p != c {
                return false;
            }
            other = self.next[other];
        }
        true
    }

    fn remove(&mut self, corner: usize) {
        let (before, after) = (self.previous[corner], self.next[corner]);
        self.next[before] = after;
        self.previous[after] = before;
        self.some = after;
        self.len -= 1;
    }

    fn remaining(&self) -> [usize; 3] {
        [self.some, self.next[self.some], self.previous[self.some]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn triangles_of(points: &[(f64, f64)]) -> Vec<[u32; 3]> {
        let vertices: Vec<Point> = points.iter().map(|(x, y)| Point::new(*x, *y, 1.0)).collect();
        triangles_in_space(&vertices)
    }

    fn triangles_in_space(vertices: &[Point]) -> Vec<[u32; 3]> {
        let corners: Vec<u32> = (0..vertices.len() as u32).collect();
        let mut triangles = vec![[0; 3]; corners.len() - 2];
        triangulate(&corners, vertices, &mut triangles).unwrap();
        triangles
    }

    fn fan(count: u32) -> Vec<[u32; 3]> {
        (0..count - 2).map(|k| [0, k + 1, k + 2]).collect()
    }

    #[test]
    fn convex_faces_are_fans_from_either_side_and_with_straight_corners() {
        let hexagon = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 2.0), (0.0, 1.0)];
        assert_eq!(triangles_of(&hexagon), fan(6));
        let mut reversed = hexagon;
        reversed.reverse();
        assert_eq!(triangles_of(&reversed), fan(6));
    }

    #[test]
    fn concave_faces_lose_ears() {
        // An arrow head whose notch is corner 1: the fan from corner 0 would leave the outline.
        let arrow = [(4.0, 4.0), (0.0, 2.0), (-4.0, 4.0), (-2.0, 1.0), (0.0, 0.0)];
        assert_eq!(triangles_of(&arrow), [[4, 0, 1], [4, 1, 2], [2, 3, 4]]);
    }

    #[test]
    fn a_star_that_crosses_itself_still_gives_all_its_triangles() {
        let star = [(0.0, 3.0), (2.0, -3.0), (-3.0, 1.0), (3.0, 1.0), (-2.0, -3.0)];
        assert_eq!(triangles_of(&star).len(), 3);
        assert_ne!(triangles_of(&star), fan(5), "it turns one way all around, but twice");
    }

    #[test]
    fn faces_without_a_plane_are_fans() {
        assert_eq!(triangles_of(&[(1.0, 1.0); 6]), fan(6));
        assert_eq!(triangles_of(&[(0.0, 0.0), (1.0, 0.0), (f64::NAN, 1.0), (0.5, 3.0), (0.0, 1.0)]), fan(5));
    }

    #[test]
    fn large_faces_are_quick_or_refused() {
        let circle = |count: usize, radius: &dyn Fn(usize) -> f64| -> Vec<Point> {
            let angle = |k: usize| k as f64 / count as f64 * std::f64::consts::TAU;
            (0..count).map(|k| Point::new(radius(k) * angle(k).cos(), radius(k) * angle(k).sin(), 0.0)).collect()
        };
        assert_eq!(triangles_in_space(&circle(100_000, &|_| 1e6)), fan(100_000));
        let gear = circle(MAX_CONCAVE + 1, &|k| if k % 2 == 0 { 1.0 } else { 2.0 });
        let corners: Vec<u32> = (0..gear.len() as u32).collect();
        let mut triangles = vec![[0; 3]; corners.len() - 2];
        assert_eq!(triangulate(&corners, &gear, &mut triangles), Err(TooManyCorners));
    }

    /// Twice the area of the outline that lies under each triangle adds up to the outline's own, which it does only
    /// where the triangles neither overlap nor leave gaps.
    fn doubled_area(points: &[(f64, f64)], triangles: &[[u32; 3]]) -> f64 {
        let point = |k: u32| [points[k as usize].0, points[k as usize].1];
        triangles.iter().map(|t| turn(point(t[0]), point(t[1]), point(t[2])).abs()).sum()
    }

    proptest! {
        /// Outlines around a centre never cross themselves; small integers make straight and coincident corners.
        #[test]
        fn triangles_tile_star_shaped_faces(radii in prop::collection::vec(1i32..6, 5..20)) {
            let count = radii.len() as f64;
            let place = |(k, r): (usize, &i32)| {
                let (sin, cos) = (k as f64 / count * std::f64::consts::TAU).sin_cos();
                (f64::from(*r) * cos, f64::from(*r) * sin)
            };
            let points: Vec<(f64, f64)> = radii.iter().enumerate().map(place).collect();
            let triangles = triangles_of(&points);
            prop_assert_eq!(triangles.len(), points.len() - 2);
            let outline = (0..points.len()).map(|k| {
                let (a, b) = (points[k], points[(k + 1) % points.len()]);
                a.0 * b.1 - a.1 * b.0
            });
            let area: f64 = outline.sum();
            prop_assert!((doubled_area(&points, &triangles) - area).abs() < 1e-9 * area);
        }

        #[test]
        fn any_outline_gives_all_its_triangles(points in prop::collection::vec((-3i32..4, -3i32..4), 5..12)) {
            let points: Vec<(f64, f64)> = points.iter().map(|(x, y)| (f64::from(*x), f64::from(*y))).collect();
            let triangles = triangles_of(&points);
            prop_assert_eq!(triangles.len(), points.len() - 2);
            prop_assert!(triangles.iter().flatten().all(|corner| (*corner as usize) < points.len()));
        }
    }
}
