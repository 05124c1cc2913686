//! The nearest of several primitives along a ray, decided exactly.

use super::ties::Ties;
use crate::accel::hit::{ExactFallbacks, Hit};
use crate::exact::{Bracket, Root};
use crate::geometry::Ray;
use crate::shape::{
    Coincidence, FilterRay, FilterResult, Geometry, InstancedId, Primitive, Triangle,
};
use std::cmp::Ordering;

/// The best hit so far of a ray among the primitives that were tested.
///
/// The result is that of exact arithmetic on all of them, in any order: the filter's decisions are
/// right, its brackets contain the true `t`, and if two brackets overlap the true numbers are
/// compared.
pub(crate) struct Nearest<'a> {
    geometry: &'a Geometry,
    /// Whether some primitives have an alpha, which decides whether a hit counts (rule A1).
    has_cut_outs: bool,
    ray: FilterRay,
    best: Option<Candidate>,
    ties: &'a mut Ties,
    fallbacks: &'a mut ExactFallbacks,
}

struct Candidate {
    primitive: InstancedId,
    t: Bracket,
    /// The exact `t`, once it has been computed. It is rare and large.
    root: Option<Box<Root>>,
}

impl<'a> Nearest<'a> {
    pub(crate) fn new(
        geometry: &'a Geometry,
        ray: &Ray,
        ties: &'a mut Ties,
        fallbacks: &'a mut ExactFallbacks,
    ) -> Nearest<'a> {
        Nearest {
            geometry,
            has_cut_outs: geometry.has_cut_outs(),
            ray: FilterRay::new(ray),
            best: None,
            ties,
            fallbacks,
        }
    }

    /// Starts with a known hit at a `t` within the bracket.
    pub(crate) fn hold(&mut self, primitive: InstancedId, t: Bracket) {
        self.best = Some(Candidate {
            primitive,
            t,
            root: None,
        });
    }

    /// The bracket of the best hit.
    #[inline]
    pub(crate) fn best_t(&self) -> Option<&Bracket> {
        self.best.as_ref().map(|best| &best.t)
    }

    /// Tests a primitive that can be hit. Returns whether it is now the best hit.
    #[inline]
    pub(crate) fn test(&mut self, primitive: InstancedId, surface: &Primitive) -> bool {
        if self.has_cut_outs && self.geometry.alpha_of(primitive).is_some() {
            return self.test_cut_out(primitive, surface);
        }
        self.decide(primitive, surface.filter(&self.ray), || *surface)
    }

    /// Like [`Nearest::test`], for a triangle.
    #[inline]
    pub(crate) fn test_triangle(&mut self, primitive: InstancedId, triangle: &Triangle) -> bool {
        if self.has_cut_outs && self.geometry.alpha_of(primitive).is_some() {
            return self.test_cut_out(primitive, &Primitive::Triangle(*triangle));
        }
        let result = triangle.filter(&self.ray);
        self.decide(primitive, result, || Primitive::Triangle(*triangle))
    }

    /// Tests a primitive with an alpha: its first hit that counts.
    #[cold]
    fn test_cut_out(&mut self, primitive: InstancedId, surface: &Primitive) -> bool {
        let first = surface.filter(&self.ray);
        if let (Some(best), FilterResult::Hit(t)) = (&self.best, &first)
            && best.t.is_below(t)
        {
            // No hit of it is nearer, whichever counts.
            return false;
        }
        let (geometry, spaces) = (self.geometry, &mut self.ties.spaces);
        let (result, number) = geometry.kept_after((primitive, surface), first, &self.ray, spaces);
        match result {
            FilterResult::Unsure => self.offer_root(primitive, surface, number),
            result => self.decide(primitive, result, || *surface),
        }
    }

    /// Takes the result of the filter, or else tests the primitive exactly.
    #[inline]
    fn decide(
        &mut self,
        primitive: InstancedId,
        result: FilterResult,
        surface: impl FnOnce() -> Primitive,
    ) -> bool {
        match result {
            FilterResult::Miss => false,
            FilterResult::Hit(t) => self.offer(Candidate {
                primitive,
                t,
                root: None,
            }),
            FilterResult::Unsure => self.test_exactly(primitive, &surface()),
        }
    }

    /// Takes a hit if it is nearer than the best, or as near and first in the file (rule E3).
    #[inline]
    fn offer(&mut self, mut candidate: Candidate) -> bool {
        let t = candidate.t;
        if let Some(best) = &self.best {
            if best.t.is_below(&t) {
                return false;
            }
            if !t.is_below(&best.t) && !self.wins_close(&mut candidate) {
                return false;
            }
        }
        self.best = Some(candidate);
        true
    }

    #[cold]
    fn test_exactly(&mut self, primitive: InstancedId, surface: &Primitive) -> bool {
        self.offer_root(primitive, surface, 0)
    }

    /// Takes the hit of number `number`, if there is one, by an exact test.
    fn offer_root(&mut self, primitive: InstancedId, surface: &Primitive, number: usize) -> bool {
        self.fallbacks.unsure_tests += 1;
        let root = surface.exact_number(&self.ray.ray, number);
        root.is_some_and(|root| {
            self.offer(Candidate {
                primitive,
                t: root.bracket(),
                root: Some(Box::new(root)),
            })
        })
    }

    /// Tests whether a hit beats the best one although their brackets overlap.
    #[cold]
    fn wins_close(&mut self, candidate: &mut Candidate) -> bool {
        let geometry = self.geometry;
        let best = self
            .best
            .as_mut()
            .expect("there is a best hit to compare with");
        let comes_first = geometry.precedes(candidate.primitive, best.primitive);
        match self
            .ties
            .between(geometry, best.primitive, candidate.primitive)
        {
            Coincidence::SameHit => return comes_first,
            // The filter gives each root one bracket, and different roots disjoint brackets.
            Coincidence::SameRoots if candidate.root.is_none() && candidate.t == best.t => {
                return comes_first;
            }
            Coincidence::SameRoots | Coincidence::None => {}
        }
        self.fallbacks.comparisons += 1;
        match candidate
            .root(geometry, &self.ray.ray)
            .cmp(best.root(geometry, &self.ray.ray))
        {
            Ordering::Less => true,
            Ordering::Equal => comes_first,
            Ordering::Greater => false,
        }
    }

    /// The best hit.
    pub(crate) fn hit(&self) -> Option<Hit> {
        let is_hard = self.fallbacks.is_any();
        self.best.as_ref().map(|best| Hit {
            primitive: best.primitive,
            t: best.t,
            is_hard,
        })
    }
}

impl Candidate {
    fn root(&mut self, geometry: &Geometry, ray: &Ray) -> &Root {
        self.root
            .get_or_insert_with(|| Box::new(geometry.exact_t(self.primitive, ray)))
    }
}
