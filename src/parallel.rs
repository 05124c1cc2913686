//! Vectors of parallel iterators.

use rayon::iter::IndexedParallelIterator;

/// Iterators whose length is known.
pub(crate) trait CollectVec: IndexedParallelIterator {
    /// The items in their order.
    ///
    /// Use it in place of rayon's `collect`, which compiles each iterator a second time, for a
    /// length that is unknown.
    fn collect_vec(self) -> Vec<Self::Item> {
        let mut items = Vec::new();
        self.collect_into_vec(&mut items);
        items
    }
}

impl<I: IndexedParallelIterator> CollectVec for I {}
