//! A grid over the centres of primitives, for bins and Morton codes.

use super::build_primitive::{BuildPrimitive, centre_bounds};
use super::f32x4::F32x4;

/// Maps doubled centres to cells on each axis. The first and the last cell are half as wide as the
/// others.
#[derive(Debug, Clone, Copy)]
pub(super) struct CentreGrid {
    low: F32x4,
    extent: F32x4,
    /// Cells per unit; 0 on an axis without extent.
    per_unit: F32x4,
    /// The last cell on each axis.
    pub(super) last: u32,
}

impl CentreGrid {
    pub(super) fn new(primitives: &[BuildPrimitive], last: u32) -> CentreGrid {
        let centres = centre_bounds(primitives);
        let extent = centres.extent();
        let per_unit = |extent: f32| match extent > 0.0 {
            true => last as f32 / extent,
            false => 0.0,
        };
        let [x, y, z, _] = extent.0.map(per_unit);
        CentreGrid {
            low: centres.low,
            extent,
            per_unit: F32x4([x, y, z, 0.0]),
            last,
        }
    }

    /// Tests whether the centres differ on an axis.
    pub(super) fn has_extent(&self, axis: usize) -> bool {
        self.per_unit.0[axis] > 0.0
    }

    /// The cell on each axis, in the lowest 22 bits; an arbitrary number for the NaN of an infinite
    /// box.
    #[inline(always)]
    pub(super) fn cells(&self, primitive: &BuildPrimitive) -> [u32; 3] {
        let from_low = primitive.doubled_centre().minus(self.low);
        let [x, y, z, _] = from_low.times(self.per_unit).rounded();
        [x, y, z]
    }

    /// The doubled coordinate of the boundary before a cell.
    pub(super) fn boundary(&self, axis: usize, cell: usize) -> f32 {
        let share = (cell as f32 - 0.5) / self.last as f32;
        self.low.0[axis] + share * self.extent.0[axis]
    }
}
