//! Sorts primitives along a Morton curve.

use super::build_primitive::{BuildPrimitive, centre_bounds};
use super::lanes::{LaneBox, Lanes};
use super::radix_sort::sort_by_digits;
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
    let grid = Grid::new(centre_bounds(primitives), axis_bits);
    let place = |(index, primitive): (usize, &BuildPrimitive)| {
        CurvePlace(u64::from(grid.code(primitive)) << 32 | index as u64)
    };
    let places = primitives.par_iter().enumerate().map(place).collect();
    sort_by_digits(places, 3 * axis_bits, |place| place.code())
}

/// A grid with the same number of cells on each axis. The first and the last are half as wide as
/// the others.
struct Grid {
    low: Lanes,
    cells_per_unit: Lanes,
    last: u32,
}

impl Grid {
    fn new(centres: LaneBox, axis_bits: u32) -> Grid {
        let last = (1 << axis_bits) - 1;
        let [x, y, z, _] = centres.extent().0;
        let cells = |extent: f32| {
            if extent > 0.0 {
                last as f32 / extent
            } else {
                0.0
            }
        };
        Grid {
            low: centres.low,
            cells_per_unit: Lanes([cells(x), cells(y), cells(z), 0.0]),
            last,
        }
    }

    #[inline]
    fn code(&self, primitive: &BuildPrimitive) -> u32 {
        let [x, y, z, _] = primitive
            .doubled_centre()
            .minus(self.low)
            .times(self.cells_per_unit)
            .rounded();
        // The NaN of an infinite box falls into an arbitrary cell.
        let spread = |cell: u32| spread(cell & self.last);
        spread(z) << 2 | spread(y) << 1 | spread(x)
    }
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
