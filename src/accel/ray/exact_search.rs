//! The nearest hit of a ray, decided exactly.

use super::traversal::Search;
use crate::accel::hit::{Fallbacks, Hit};
use crate::accel::space::SlabRay;
use crate::exact::{Bracket, Root};
use crate::geometry::Ray;
use crate::shape::{FilterRay, Placed, Shapes, Surface, Verdict};
use std::cmp::Ordering;

/// The best hit so far of a ray among the primitives that were tested.
///
/// The answer is that of exact arithmetic on all of them, in whatever order they come: the filter's verdicts are right, its
/// brackets hold the true `t`, and where two brackets overlap the true numbers are compared.
pub(in crate::accel) struct ExactSearch<'a> {
    shapes: &'a Shapes,
    ray: FilterRay,
    slab: &'a SlabRay,
    best: Option<Candidate>,
    /// The upper end of the best bracket in the units of the slab test: what is entered later is culled.
    limit: f32,
    fallbacks: &'a mut Fallbacks,
}

struct Candidate {
    primitive: Placed,
    t: Bracket,
    /// The exact `t`, once it has been asked for.
    root: Option<Root>,
}

impl<'a> ExactSearch<'a> {
    pub(in crate::accel) fn new(
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
    fn test_exactly(&mut self, primitive: Placed, surface: &Surface) {
        self.fallbacks.unsure_tests += 1;
        if let Some(root) = surface.exact(&self.ray.ray) {
            self.offer(Candidate { primitive, t: root.bracket(), root: Some(root) });
        }
    }

    /// Whether a hit beats the best one, where the brackets overlap.
    #[cold]
    fn wins_close(&mut self, candidate: &mut Candidate) -> bool {
        let shapes = self.shapes;
        let best = self.best.as_mut().expect("there is a best hit to compare with");
        let comes_first = shapes.precedes(candidate.primitive, best.primitive);
        if shapes.surface(candidate.primitive).coincides_with(&shapes.surface(best.primitive)) {
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
        self.root.get_or_insert_with(|| shapes.surface(self.primitive).exact_t(ray))
    }
}

impl Search for ExactSearch<'_> {
    #[inline]
    fn test(&mut self, primitive: Placed) {
        let Some(surface) = self.shapes.surface_in_tree(primitive) else { return };
        match surface.filter(&self.ray) {
            Verdict::Miss => {}
            Verdict::Hit(t) => self.offer(Candidate { primitive, t, root: None }),
            Verdict::Unsure => self.test_exactly(primitive, &surface),
        }
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline]
    fn has_hit(&self) -> bool {
        self.best.is_some()
    }

    fn into_hit(self) -> Option<Hit> {
        let is_hard = self.fallbacks.is_any();
        self.best.map(|best| Hit { primitive: best.primitive, t: best.t, is_hard })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::space::AnchorSpace;
    use crate::geometry::{Matrix, Point};
    use crate::shape::Primitive;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// Slivers, of which the filter knows the t least well: what lies before the hit must still be looked at.
        #[test]
        fn the_limit_is_not_before_the_hit(
            ends in prop::array::uniform6(-1.0f64..1.0),
            aside in prop::array::uniform3(-1.0f64..1.0),
            thinness in -52i32..-20,
            weights in prop::array::uniform3(0.05f64..1.0),
            origin in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let (a, b) = (Point::new(ends[0], ends[1], ends[2]), Point::new(ends[3], ends[4], ends[5]));
            let middle = |k: usize| 0.4 * a[k] + 0.6 * b[k] + aside[k] * 2f64.powi(thinness);
            let c = Point::new(middle(0), middle(1), middle(2));
            let mut shapes = Shapes::default();
            shapes.add_mesh(vec![a, b, c], vec![[0, 1, 2]], &Matrix::IDENTITY, 1).unwrap();
            let sum = weights[0] + weights[1] + weights[2];
            let target = |k: usize| (weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k]) / sum;
            let origin = Point::from(origin);
            let direction = Point::new(target(0), target(1), target(2)) - origin;
            let ray = Ray { origin, direction };
            let primitive = Placed::alone(Primitive::triangle(0));
            let Some(root) = shapes.surface(primitive).exact(&ray) else { return Ok(()) };
            let slab = AnchorSpace::new(origin, 4.0).ray(&ray);
            let mut fallbacks = Fallbacks::default();
            let mut search = ExactSearch::new(&shapes, &ray, &slab, &mut fallbacks);
            search.test(primitive);
            // Narrowed to f32 as the limit is, the true number is not above it.
            let truth = slab.scaled_limit(root.bracket().low);
            prop_assert!(search.limit() >= truth, "{} < {truth}", search.limit());
        }
    }
}
