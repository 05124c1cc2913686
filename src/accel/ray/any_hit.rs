//! A search that ends with the first hit it finds.

use super::search::Search;
use crate::accel::hit::Hit;
use crate::shape::InstancedId;

/// Ends a search with its first hit. Which one that is depends on the tree.
pub(crate) struct AnyHit<'a, S> {
    search: &'a mut S,
}

impl<S: Search> AnyHit<'_, S> {
    pub(crate) fn new(search: &mut S) -> AnyHit<'_, S> {
        AnyHit { search }
    }
}

impl<S: Search> Search for AnyHit<'_, S> {
    #[inline]
    fn test(&mut self, primitive: InstancedId) {
        if !self.search.has_hit() {
            self.search.test(primitive);
        }
    }

    /// After a hit, nothing is entered any more.
    #[inline]
    fn limit(&self) -> f32 {
        if self.search.has_hit() {
            f32::NEG_INFINITY
        } else {
            f32::INFINITY
        }
    }

    fn has_hit(&self) -> bool {
        self.search.has_hit()
    }

    fn is_exact(&self) -> bool {
        self.search.is_exact()
    }

    fn hit(&self) -> Option<Hit> {
        self.search.hit()
    }
}
