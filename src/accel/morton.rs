//! Places along a Morton curve.

use super::build_primitive::{BuildPrimitive, centre_bounds};
use super::lanes::LaneBox;
use super::radix_sort::sort_from_bit;
use rayon::prelude::*;

/// Bits of a Morton code on each axis.
const AXIS_BITS: u32 = 10;

/// The places in the list of `primitives` in the order of the curve, where codes are equal in that of the list: the
/// lower half of each key. The upper one is the code.
pub(super) fn along_curve(primitives: &[BuildPrimitive]) -> Vec<u64> {
    let grid = Grid::over(centre_bounds(primitives));
    let key = |(index, primitive): (usize, &BuildPrimitive)| u64::from(grid.code(primitive)) << 32 | index as u64;
    sort_from_bit(primitives.par_iter().enumerate().map(key).collect(), 32)
}

/// 2^10 cells an axis.
struct Grid {
    low: [f32; 4],
    cells_per_unit: [f32; 4],
}

impl Grid {
    fn over(centres: LaneBox) -> Grid {
        let cells = |extent: f32| if extent > 0.0 { (1 << AXIS_BITS) as f32 / extent } else { 0.0 };
        Grid { low: centres.low.0, cells_per_unit: centres.extent().0.map(cells) }
    }

    fn code(&self, primitive: &BuildPrimitive) -> u32 {
        let centre = primitive.doubled_centre().0;
        let cell = |k: usize| {
            // A NaN, from infinite boxes, becomes 0.
            let cell = ((centre[k] - self.low[k]) * self.cells_per_unit[k]) as u32;
            spread(cell.min((1 << AXIS_BITS) - 1))
        };
        cell(2) << 2 | cell(1) << 1 | cell(0)
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
