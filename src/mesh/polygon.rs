//! Cuts polygons into triangles, by a procedure that never changes: primitive ids depend on it.
//!
//! A face with corners 0 to n-1 has n-2 triangles, whatever its shape, in this order:
//!
//! 1. **Three or four corners**: (0, 1, 2), then (0, 2, 3). A concave quadrilateral is no
//!    exception.
//! 2. **Flattening.** With q the corners minus corner 0, the Newell normal is the sum over the
//!    edges from a to b, from the edge 0-1 on, of `((a.y-b.y)*(a.z+b.z), (a.z-b.z)*(a.x+b.x),
//!    (a.x-b.x)*(a.y+b.y))`. The axis of its largest absolute component, the first of x, y, z if
//!    equal, is dropped. u and v are the two axes that follow it in the cycle x, y, z, exchanged if
//!    that component is negative, so that the polygon turns left. From here on only u and v of the
//!    original corners count. A face with a corner or a normal that is not finite becomes its fan,
//!    as in step 4.
//! 3. **Turns.** The turn from a over b to c is `(b.u-a.u)*(c.v-a.v) - (b.v-a.v)*(c.u-a.u)`,
//!    rounded to `f64` after each operation. Its sign decides; NaN is neither positive nor negative
//!    nor zero.
//! 4. **Convex**: every turn at a corner is at least 0, and the edges go around once: those not of
//!    zero length change exactly twice between *upwards* (dv > 0, or dv = 0 and du > 0) and
//!    *downwards*. Then the face becomes its fan: (0, k, k+1) for k from 1 to n-2.
//! 5. **Ears.** Otherwise corners are cut off until three are left. Each has a previous and a next
//!    corner p and n among those left. A corner c is an *ear* if the turn p, c, n is positive and
//!    no other corner left blocks it: one whose own turn is not positive, that is not at the
//!    position (u, v) of p, c or n, and none of whose turns p-c, c-n, n-p to it is negative. The
//!    search starts at corner 0 and goes to the next corner until it finds an ear. The ear is cut:
//!    the triangle (p, c, n) comes out, and the search continues at n.
//! 6. **No ear** among all the corners left (the outline crosses or touches itself): then the first
//!    corner whose turn is 0, from the start of this search on, is cut instead; if there is none,
//!    the corner at the start.
//! 7. **The last three** come out from the lowest number on, in order.
//!
//! A face that is not convex is refused if it has more than 10,000 corners, or if steps 5 and 6
//! look at more than 8 n^2 pairs of corners, as only outlines do that cross themselves everywhere.
//! It is also refused if the faces before it in the files of a scene have looked at more than 2 n^2
//! pairs, for the largest of them, and 1,000 for each byte of the files. So no file takes forever.

use super::flat_polygon::{Flat, flatten, is_convex, turn};
use crate::error::{Diagnostic, Error, Result};
use crate::geometry::Point;
use crate::input::{Budget, pairs_of};

const MOST_CORNERS: usize = 10_000;

/// Appends the triangles of the face with these `corners`, which are indices of `vertices`.
pub fn triangulate(
    corners: &[u32],
    vertices: &[Point],
    clipper: &mut Clipper<'_>,
    triangles: &mut Vec<[u32; 3]>,
) -> Result<()> {
    if corners.len() <= 4
        || !flatten(corners, vertices, &mut clipper.flat)
        || is_convex(&clipper.flat)
    {
        fan(corners, triangles);
        return Ok(());
    }
    if corners.len() > MOST_CORNERS {
        let message = format!("a face of {} corners that is not convex", corners.len());
        return Err(refused(
            message,
            format!("at most {MOST_CORNERS} corners are supported"),
        ));
    }
    clipper.clip(corners, triangles).ok_or_else(|| {
        let message = format!(
            "the outline of a face of {} corners crosses itself too often",
            corners.len()
        );
        let error = refused(message, "split the face into simple polygons".to_string());
        clipper
            .budget
            .iter()
            .fold(error, |error, budget| error.note(budget.advice()))
    })
}

fn refused(message: String, note: String) -> Error {
    Error::bad_input(Diagnostic::new(message).note(note))
}

fn fan(corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    if let [first, rest @ ..] = corners {
        triangles.extend(rest.windows(2).map(|edge| [*first, edge[0], edge[1]]));
    }
}

/// The working memory of steps 2 to 7, reused for each face.
#[derive(Default)]
pub struct Clipper<'a> {
    flat: Vec<Flat>,
    previous: Vec<usize>,
    next: Vec<usize>,
    /// The remaining corners whose turn is not positive, sorted.
    blockers: Vec<usize>,
    /// The corner that last blocked each corner: it probably still does.
    blocked_by: Vec<Option<u32>>,
    is_cut: Vec<bool>,
    /// The number of pairs of corners that may still be looked at.
    pairs: u64,
    /// The budget of the pairs.
    budget: Option<&'a Budget<'a>>,
}

impl<'a> Clipper<'a> {
    /// A clipper for the polygons of a scene.
    pub(crate) fn within(budget: &'a Budget) -> Clipper<'a> {
        Clipper {
            budget: Some(budget),
            ..Clipper::default()
        }
    }

    /// Steps 5 to 7; `None` if they would look at too many pairs.
    fn clip(&mut self, corners: &[u32], triangles: &mut Vec<[u32; 3]>) -> Option<()> {
        self.begin();
        let before = self.pairs;
        let cut = self.cut_all(corners, triangles);
        self.budget
            .iter()
            .for_each(|budget| budget.charge_pairs(before - self.pairs));
        cut
    }

    fn cut_all(&mut self, corners: &[u32], triangles: &mut Vec<[u32; 3]>) -> Option<()> {
        let mut start = 0;
        for left in (4..=corners.len()).rev() {
            let corner = self.choose(start, left)?;
            let (previous, next) = (self.previous[corner], self.next[corner]);
            triangles.push([corners[previous], corners[corner], corners[next]]);
            self.cut(corner);
            start = next;
        }
        let lowest = self.is_cut.iter().position(|cut| !cut)?;
        let second = self.next[lowest];
        triangles.push([corners[lowest], corners[second], corners[self.next[second]]]);
        Some(())
    }

    fn begin(&mut self) {
        let count = self.flat.len();
        self.previous.clear();
        self.previous
            .extend((0..count).map(|at| (at + count - 1) % count));
        self.next.clear();
        self.next.extend((0..count).map(|at| (at + 1) % count));
        self.blocked_by.clear();
        self.blocked_by.resize(count, None);
        self.is_cut.clear();
        self.is_cut.resize(count, false);
        self.pairs = self
            .budget
            .map_or_else(|| pairs_of(count as u64), |budget| budget.pairs_left(count));
        self.collect_blockers();
    }

    fn collect_blockers(&mut self) {
        let mut blockers = std::mem::take(&mut self.blockers);
        blockers.clear();
        blockers.extend((0..self.flat.len()).filter(|at| !self.is_left_turn(*at)));
        self.blockers = blockers;
    }

    fn turn_at(&self, corner: usize) -> f64 {
        turn(
            self.flat[self.previous[corner]],
            self.flat[corner],
            self.flat[self.next[corner]],
        )
    }

    fn is_left_turn(&self, corner: usize) -> bool {
        self.turn_at(corner) > 0.0
    }

    /// The corner to cut among the remaining ones, searched for from `start`.
    fn choose(&mut self, start: usize, left: usize) -> Option<usize> {
        let mut flat_corner = None;
        let mut corner = start;
        for _ in 0..left {
            self.pairs = self.pairs.checked_sub(1)?;
            if self.is_ear(corner)? {
                return Some(corner);
            }
            if flat_corner.is_none() && self.turn_at(corner) == 0.0 {
                flat_corner = Some(corner);
            }
            corner = self.next[corner];
        }
        Some(flat_corner.unwrap_or(start))
    }

    fn is_ear(&mut self, corner: usize) -> Option<bool> {
        if !self.is_left_turn(corner) {
            return Some(false);
        }
        if self.blocked_by[corner].is_some_and(|blocker| self.blocks(blocker as usize, corner)) {
            return Some(false);
        }
        let found = self
            .blockers
            .iter()
            .position(|blocker| self.blocks(*blocker, corner));
        self.blocked_by[corner] = found.map(|at| self.blockers[at] as u32);
        let looked_at = found.unwrap_or(self.blockers.len()) as u64;
        self.pairs = self.pairs.checked_sub(looked_at)?;
        Some(found.is_none())
    }

    /// Whether `blocker` prevents `corner` from being an ear.
    fn blocks(&self, blocker: usize, corner: usize) -> bool {
        let point = self.flat[blocker];
        let triangle = [self.previous[corner], corner, self.next[corner]].map(|at| self.flat[at]);
        let [a, b, c] = triangle;
        let outside = turn(a, b, point) < 0.0 || turn(b, c, point) < 0.0 || turn(c, a, point) < 0.0;
        !outside
            && !triangle.contains(&point)
            && !self.is_cut[blocker]
            && !self.is_left_turn(blocker)
    }

    fn cut(&mut self, corner: usize) {
        let (previous, next) = (self.previous[corner], self.next[corner]);
        self.next[previous] = next;
        self.previous[next] = previous;
        self.is_cut[corner] = true;
        self.set_blocking(corner, false);
        // The turns of all other corners are unchanged.
        self.set_blocking(previous, !self.is_left_turn(previous));
        self.set_blocking(next, !self.is_left_turn(next));
    }

    /// Adds `corner` to the sorted blockers, or removes it.
    fn set_blocking(&mut self, corner: usize, is_blocker: bool) {
        match (self.blockers.binary_search(&corner), is_blocker) {
            (Ok(place), false) => _ = self.blockers.remove(place),
            (Err(place), true) => self.blockers.insert(place, corner),
            _ => {}
        }
    }
}
