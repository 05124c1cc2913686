//! Whether a ray hits anything.

use super::traversal::Search;
use crate::accel::hit::Hit;
use crate::shape::InstancedId;

/// A search that ends with its first hit: which one that is, depends on the tree.
pub(crate) struct AnyHit<S> {
    search: S,
}

impl<S: Search> AnyHit<S> {
    pub(crate) fn new(search: S) -> AnyHit<S> {
        AnyHit { search }
    }
}

impl<S: Search> Search for AnyHit<S> {
    #[inline]
    fn test(&mut self, primitive: InstancedId) {
        if !self.search.has_hit() {
            self.search.test(primitive);
        }
    }

    /// Nothing is entered before this once something is hit.
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

    fn into_hit(self) -> Option<Hit> {
        self.search.into_hit()
    }
}
