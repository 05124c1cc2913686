//! The nearest hit of a ray, decided exactly.

use super::hit::{Fallbacks, Hit};
use super::slab_ray::SlabRay;
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
    slab: &'a SlabRay,
    best: Option<Candidate>,
    /// The upper end of the best bracket in the units of the slab test: what is entered later is culled.
    limit: f32,
    fallbacks: &'a mut Fallbacks,
}

struct Candidate {
    primitive: Primitive,
    t: Bracket,
    /// The exact `t`, once it has been asked for.
    root: Option<Root>,
}

impl<'a> ExactSearch<'a> {
    pub(super) fn new(
        shapes: &'a Shapes,
        ray: &Ray,
        slab: &'a SlabRay,
        fallbacks: &'a mut Fallbacks,
    ) -> ExactSearch<'a> {
        ExactSearch { shapes, ray: FilterRay::new(ray), slab, best: None, limit: f32::INFINITY, fallbacks }
    }

    /// Takes a hit, if it is nearer than the best, or as near and before it in the file (rule E3).
    #[inline]
    fn offer(&mut self, mut candidate: Candidate) {
        let t = candidate.t;
        if let Some(best) = &self.best {
            if best.t.is_below(&t) {
                return;
            }
            if !t.is_below(&best.t) && !self.wins_close(&mut candidate) {
                return;
            }
        }
        self.best = Some(candidate);
        self.limit = self.slab.scaled_limit(t.high);
    }

    #[cold]
    fn test_exactly(&mut self, primitive: Primitive) {
        self.fallbacks.unsure_tests += 1;
        if let Some(root) = self.shapes.exact(primitive, &self.ray.ray) {
            self.offer(Candidate { primitive, t: root.bracket(), root: Some(root) });
        }
    }

    /// Whether a hit beats the best one, where the brackets overlap.
    #[cold]
    fn wins_close(&mut self, candidate: &mut Candidate) -> bool {
        let shapes = self.shapes;
        let best = self.best.as_mut().expect("there is a best hit to compare with");
        let comes_first = shapes.precedes(candidate.primitive, best.primitive);
        if shapes.coincide(candidate.primitive, best.primitive) {
            return comes_first;
        }
        self.fallbacks.comparisons += 1;
        match candidate.root(shapes, &self.ray.ray).cmp(best.root(shapes, &self.ray.ray)) {
            Ordering::Less => true,
            Ordering::Equal => comes_first,
            Ordering::Greater => false,
        }
    }
}

impl Candidate {
    fn root(&mut self, shapes: &Shapes, ray: &Ray) -> &Root {
        self.root.get_or_insert_with(|| shapes.exact_t(self.primitive, ray))
    }
}

impl Search for ExactSearch<'_> {
    #[inline]
    fn test(&mut self, primitive: Primitive) {
        match self.shapes.filter(primitive, &self.ray) {
            Verdict::Miss => {}
            Verdict::Hit(t) => self.offer(Candidate { primitive, t, root: None }),
            Verdict::Unsure => self.test_exactly(primitive),
        }
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.limit
    }

    fn into_hit(self) -> Option<Hit> {
        let is_hard = self.fallbacks.is_any();
        self.best.map(|best| Hit { primitive: best.primitive, t: best.t, is_hard })
    }
}
