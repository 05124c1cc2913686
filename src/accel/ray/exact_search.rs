//! The nearest hit of a ray, decided exactly, with the limit that culls nodes.

use super::nearest::Nearest;
use super::search::Search;
use super::ties::Ties;
use crate::accel::hit::{ExactFallbacks, Hit};
use crate::accel::space::SlabRay;
use crate::geometry::Ray;
use crate::shape::{Geometry, InstancedId};

/// The best hit so far of a ray that traverses a tree.
pub(crate) struct ExactSearch<'a> {
    geometry: &'a Geometry,
    nearest: Nearest<'a>,
    slab: &'a SlabRay,
    /// The upper end of the best bracket in the units of the slab test. Boxes entered later are
    /// culled.
    limit: f32,
}

impl<'a> ExactSearch<'a> {
    pub(crate) fn new(
        geometry: &'a Geometry,
        ray: &Ray,
        slab: &'a SlabRay,
        ties: &'a mut Ties,
        fallbacks: &'a mut ExactFallbacks,
    ) -> ExactSearch<'a> {
        ExactSearch {
            geometry,
            nearest: Nearest::new(geometry, ray, ties, fallbacks),
            slab,
            limit: f32::INFINITY,
        }
    }
}

impl Search for ExactSearch<'_> {
    #[inline]
    fn test(&mut self, primitive: InstancedId) {
        let is_better = if primitive.is_own_triangle() {
            let triangle = self.geometry.triangle(primitive.primitive().index());
            self.nearest.test_triangle(primitive, &triangle)
        } else {
            self.geometry
                .surface_in_tree(primitive)
                .is_some_and(|surface| self.nearest.test(primitive, &surface))
        };
        if is_better && let Some(t) = self.nearest.best_t() {
            self.limit = self.slab.scaled_limit(t.high);
        }
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline]
    fn has_hit(&self) -> bool {
        self.nearest.best_t().is_some()
    }

    fn is_exact(&self) -> bool {
        true
    }

    fn hit(&self) -> Option<Hit> {
        self.nearest.hit()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::space::AnchorSpace;
    use crate::geometry::{Matrix, Point};
    use crate::shape::PrimitiveId;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// Tests slivers, whose t the filter knows least well: nodes before the hit must not be
        /// culled.
        #[test]
        fn the_limit_is_not_before_the_hit(
            ends in prop::array::uniform6(-1.0f64..1.0),
            aside in prop::array::uniform3(-1.0f64..1.0),
            thinness in -52i32..-20,
            weights in prop::array::uniform3(0.05f64..1.0),
            origin in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let a = Point::new(ends[0], ends[1], ends[2]);
            let b = Point::new(ends[3], ends[4], ends[5]);
            let middle = |k: usize| 0.4 * a[k] + 0.6 * b[k] + aside[k] * 2f64.powi(thinness);
            let c = Point::new(middle(0), middle(1), middle(2));
            let mut geometry = Geometry::default();
            geometry.add_mesh(vec![a, b, c], vec![[0, 1, 2]], &Matrix::IDENTITY, 1).unwrap();
            let sum = weights[0] + weights[1] + weights[2];
            let [u, v, w] = weights;
            let target = |k: usize| (u * a[k] + v * b[k] + w * c[k]) / sum;
            let origin = Point::from(origin);
            let direction = Point::new(target(0), target(1), target(2)) - origin;
            let ray = Ray { origin, direction };
            let primitive = InstancedId::alone(PrimitiveId::triangle(0));
            let Some(root) = geometry.surface(primitive).exact(&ray) else { return Ok(()) };
            let slab = AnchorSpace::new(origin, 4.0).ray(&ray);
            let (mut ties, mut fallbacks) = (Ties::default(), ExactFallbacks::default());
            let mut search = ExactSearch::new(&geometry, &ray, &slab, &mut ties, &mut fallbacks);
            search.test(primitive);
            // The true number, rounded to f32 like the limit, does not exceed it.
            let truth = slab.scaled_limit(root.bracket().low);
            prop_assert!(search.limit() >= truth, "{} < {truth}", search.limit());
        }
    }
}
