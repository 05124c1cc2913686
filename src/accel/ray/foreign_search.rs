//! The nearest hit of a ray by somebody else's arithmetic.

use super::traversal::Search;
use crate::accel::hit::Hit;
use crate::accel::space::SlabRay;
use crate::exact::Bracket;
use crate::shape::InstancedId;

/// The best hit so far, as `intersect` tells `t`. Of several at one `t` the one that is tested first wins, and what is entered behind
/// the best `t` is culled, however wrong that is: answers may depend on the tree, as they do elsewhere.
pub(crate) struct ForeignSearch<'a, F> {
    intersect: F,
    slab: &'a SlabRay,
    best: Option<(f32, InstancedId)>,
    limit: f32,
}

impl<'a, F: FnMut(InstancedId) -> Option<f32>> ForeignSearch<'a, F> {
    pub(crate) fn new(slab: &'a SlabRay, intersect: F) -> ForeignSearch<'a, F> {
        ForeignSearch {
            intersect,
            slab,
            best: None,
            limit: f32::INFINITY,
        }
    }
}

impl<F: FnMut(InstancedId) -> Option<f32>> Search for ForeignSearch<'_, F> {
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

    fn into_hit(self) -> Option<Hit> {
        self.best.map(|(t, primitive)| Hit {
            primitive,
            t: Bracket::exactly(t.into()),
            is_hard: false,
        })
    }
}
