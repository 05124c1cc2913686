//! The nearest hit of a ray by an intersection test that the caller supplies.

use super::search::Search;
use crate::accel::hit::Hit;
use crate::accel::space::SlabRay;
use crate::exact::Bracket;
use crate::shape::InstancedId;

/// The best hit so far, by the `t` that `intersect` computes.
///
/// At equal `t` the primitive that is tested first wins, and nodes behind the best `t` are culled,
/// however wrong it is: results may depend on the tree, as they do in other renderers.
pub(crate) struct ClosureSearch<'a, F> {
    intersect: F,
    slab: &'a SlabRay,
    best: Option<(f32, InstancedId)>,
    limit: f32,
}

impl<'a, F: FnMut(InstancedId) -> Option<f32>> ClosureSearch<'a, F> {
    pub(crate) fn new(slab: &'a SlabRay, intersect: F) -> ClosureSearch<'a, F> {
        ClosureSearch {
            intersect,
            slab,
            best: None,
            limit: f32::INFINITY,
        }
    }
}

impl<F: FnMut(InstancedId) -> Option<f32>> Search for ClosureSearch<'_, F> {
    #[inline]
    fn test(&mut self, primitive: InstancedId) {
        let Some(t) = (self.intersect)(primitive) else {
            return;
        };
        if self.best.is_none_or(|(best, _)| t < best) {
            self.best = Some((t, primitive));
            self.limit = self.slab.scaled_limit(t.into());
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

    fn is_exact(&self) -> bool {
        false
    }

    fn hit(&self) -> Option<Hit> {
        self.best.map(|(t, primitive)| Hit {
            primitive,
            t: Bracket::exactly(t.into()),
            is_hard: false,
        })
    }
}
