//! The interface between a traversal and its search for a hit.

use crate::accel::hit::Hit;
use crate::shape::InstancedId;

/// A search for a hit: tests the primitives that a ray may hit, and limits how far it has to go.
pub(crate) trait Search {
    /// Tests a primitive.
    fn test(&mut self, primitive: InstancedId);

    /// In the units of the slab test. A box that is entered later cannot contain a better hit.
    fn limit(&self) -> f32;

    /// Tests whether any tested primitive is hit.
    fn has_hit(&self) -> bool;

    /// Tests whether the result is that of exact arithmetic: then a primitive that the ray surely
    /// misses need not be tested.
    fn is_exact(&self) -> bool;

    /// The best hit among all tested primitives.
    fn hit(&self) -> Option<Hit>;
}
