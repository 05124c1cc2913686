//! The nearest hit of a ray, decided exactly.

use super::anchor_space::SlabRay;
use super::hit::{Fallbacks, Hit};
use super::traversal::Search;
use crate::exact::{Bracket, Root};
use crate::geometry::Ray;
use crate::shape::{FilterRay, Primitive, Shapes, Verdict};
use std::cmp::Ordering;

/// The best hit so far of a ray among the primitives that were tested.
///
/// The answer is that of exact arithmetic on all of them, in whatever order they come: the filter's verdicts are right, its
/// brackets hold the true `t`, and where two brackets overlap the true numbers are compared.
pub(super) struct ExactSearch<'a> {
    shapes: &'a Shapes,
    ray: FilterRay,
    exact_ray: &'a Ray,
    slab: &'a SlabRay,
    best: Option<Candidate>,
    /// The upper end of the best bracket in the units of the slab test: what is entered later is culled.
    limit: f32,
    fallbacks: &'a mut Fallbacks,
}

struct Candidate {
    hit: Hit,
    /// The exact `t`, once it has been asked for.
    root: Option<Root>,
}

impl<'a> ExactSearch<'a> {
    pub(super) fn new(
        shapes: &'a Shapes,
        exact_ray: &'a Ray,
        slab: &'a SlabRay,
        fallbacks: &'a mut Fallbacks,
    ) -> ExactSearch<'a> {
        let ray = FilterRay::new(exact_ray);
        ExactSearch { shapes, ray, exact_ray, slab, best: None, limit: f32::INFINITY, fallbacks }
    }

    /// Takes a hit, if it is nearer than the best, or as near and before it in the file (rule E3).
    #[inline]
    fn offer(&mut self, primitive: Primitive, t: Bracket, root: Option<Root>) {
        if let Some(best) = &self.best {
            if best.hit.t.is_below(&t) {
                return;
            }
            if !t.is_below(&best.hit.t) && !self.wins_close(primitive, root.clone()) {
                return;
            }
        }
        self.best = Some(Candidate { hit: Hit { primitive, t, is_hard: false }, root });
        self.limit = self.slab.scaled_limit(t.high);
    }

    #[cold]
    fn test_exactly(&mut self, primitive: Primitive) {
        self.fallbacks.unsure_tests += 1;
        if let Some(root) = self.shapes.exact(primitive, self.exact_ray) {
            self.offer(primitive, root.bracket(), Some(root));
        }
    }

    /// Whether a hit beats the best one, where the brackets overlap.
    #[cold]
    fn wins_close(&mut self, primitive: Primitive, root: Option<Root>) -> bool {
        let (shapes, ray) = (self.shapes, self.exact_ray);
        let best = self.best.as_mut().expect("there is a best hit to compare with");
        let comes_first = shapes.precedes(primitive, best.hit.primitive);
        if shapes.coincide(primitive, best.hit.primitive) {
            return comes_first;
        }
        self.fallbacks.comparisons += 1;
        let exact = |primitive| shapes.exact(primitive, ray).expect("what is surely hit is hit");
        let of_best = best.root.get_or_insert_with(|| exact(best.hit.primitive));
        match root.unwrap_or_else(|| exact(primitive)).cmp(of_best) {
            Ordering::Less => true,
            Ordering::Equal => comes_first,
            Ordering::Greater => false,
        }
    }
}

impl Search for ExactSearch<'_> {
    #[inline]
    fn test(&mut self, primitive: Primitive) {
        match self.shapes.filter(primitive, &self.ray) {
            Verdict::Miss => {}
            Verdict::Hit(t) => self.offer(primitive, t, None),
            Verdict::Unsure => self.test_exactly(primitive),
        }
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.limit
    }

    fn into_hit(self) -> Option<Hit> {
        self.best.map(|best| Hit { is_hard: self.fallbacks.is_any(), ..best.hit })
    }
}
