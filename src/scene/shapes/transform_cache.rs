//! Stores each transform once, however many shapes share it (pbrt-v3's `TransformCache`).

use crate::geometry::Matrix;
use crate::shape::Geometry;
use std::collections::HashMap;
use twox_hash::XxHash3_128;

/// Finds matrices by their bits.
#[derive(Debug, Default)]
pub(crate) struct TransformCache {
    /// The number of the first matrix with each hash of its bits. A later one with the same hash is
    /// stored again for each shape, so even a scene made for that takes no more than its file.
    number_of: HashMap<u64, u32>,
    count: usize,
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
        let hash = hash_of(matrix);
        let first = self.number_of.get(&hash).copied();
        let number = match first {
            Some(first) if geometry.transform(first).bits() == matrix.bits() => first,
            _ => {
                let number = geometry.add_transform(*matrix);
                self.number_of.entry(hash).or_insert(number);
                self.count += 1;
                number
            }
        };
        self.last = Some((*matrix, number));
        number
    }

    /// The number of transforms.
    pub(crate) fn len(&self) -> usize {
        self.count
    }
}

fn hash_of(matrix: &Matrix) -> u64 {
    let mut bytes = [0; 96];
    for (number, to) in matrix.bits().iter().zip(bytes.chunks_exact_mut(8)) {
        to.copy_from_slice(&number.to_ne_bytes());
    }
    XxHash3_128::oneshot(&bytes) as u64
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
