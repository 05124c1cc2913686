//! Stores each transform once, however many shapes share it (pbrt-v3's `TransformCache`).

use crate::geometry::Matrix;
use crate::shape::Geometry;
use std::collections::HashMap;

/// Finds matrices by their bits.
#[derive(Debug, Default)]
pub(crate) struct TransformCache {
    number_of: HashMap<[u64; 12], u32>,
    last: Option<(Matrix, u32)>,
}

impl TransformCache {
    /// The number of `matrix` in `geometry`, which stores it if it is new.
    pub(super) fn intern(&mut self, matrix: &Matrix, geometry: &mut Geometry) -> u32 {
        // Most neighbouring shapes share their transform. A NaN never equals itself: it is looked
        // up.
        if let Some((last, number)) = &self.last
            && last == matrix
            && last.bits() == matrix.bits()
        {
            return *number;
        }
        let number = *self
            .number_of
            .entry(matrix.bits())
            .or_insert_with(|| geometry.add_transform(*matrix));
        self.last = Some((*matrix, number));
        number
    }

    /// The number of transforms.
    pub(crate) fn len(&self) -> usize {
        self.number_of.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_bits_share_a_number_and_signed_zeros_do_not() {
        let (mut cache, mut geometry) = (TransformCache::default(), Geometry::default());
        let zero = Matrix::translate([0.0, 0.0, 0.0]);
        let negative_zero = Matrix::translate([-0.0, 0.0, 0.0]);
        let numbers = [zero, zero, negative_zero, zero, negative_zero]
            .map(|m| cache.intern(&m, &mut geometry));
        assert_eq!((numbers, cache.len()), ([0, 0, 1, 0, 1], 2));
    }
}
