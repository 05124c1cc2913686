//! Sorts primitives along a Morton curve.

use super::build_primitive::BuildPrimitive;
use super::centre_grid::CentreGrid;
use super::radix_sort::sort_by_digits;
use crate::parallel::CollectVec;
use rayon::prelude::*;

/// The largest number of bits of a code on each axis.
const MOST_AXIS_BITS: u32 = 10;

/// The number of bits on each axis with which a grid cell holds about ten of `count` primitives, if
/// they lie on a surface.
fn axis_bits(count: usize) -> u32 {
    (count.max(1).ilog2() / 2)
        .saturating_sub(3)
        .clamp(2, MOST_AXIS_BITS)
}

/// A primitive on the curve: its Morton code in the upper half, its index in the lower half.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct CurvePlace(u64);

impl CurvePlace {
    /// The Morton code.
    #[inline]
    pub(super) fn code(self) -> u32 {
        (self.0 >> 32) as u32
    }

    /// The index in the list of primitives.
    #[inline]
    pub(super) fn index(self) -> usize {
        self.0 as u32 as usize
    }
}

/// All `primitives` in the order of the curve; with equal codes in the order of the list.
pub(super) fn along_curve(primitives: &[BuildPrimitive]) -> Vec<CurvePlace> {
    let axis_bits = axis_bits(primitives.len());
    let grid = CentreGrid::new(primitives, (1 << axis_bits) - 1);
    let place = |(index, primitive): (usize, &BuildPrimitive)| {
        let [x, y, z] = grid.cells(primitive).map(|cell| spread(cell & grid.last));
        CurvePlace(u64::from(z << 2 | y << 1 | x) << 32 | index as u64)
    };
    let places = primitives.par_iter().enumerate().map(place).collect_vec();
    sort_by_digits(places, 3 * axis_bits, |place| place.code())
}

/// Moves bit k of a 10-bit number to bit 3k.
fn spread(cell: u32) -> u32 {
    let x = (cell | cell << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreads_ten_bits() {
        assert_eq!(spread(0b11_1111_1111), 0x0924_9249);
        assert_eq!(spread(0b10_0000_0001), 1 << 27 | 1);
    }
}
