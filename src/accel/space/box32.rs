//! Boxes in `f32`, in anchor space.

use super::rounding::{larger, smaller};

/// A box in anchor space, slightly larger than its contents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Box32 {
    pub(crate) low: [f32; 3],
    pub(crate) high: [f32; 3],
}

/// The low and the high corner of a box, each with a spare lane.
pub(crate) type Corners = [[f32; 4]; 2];

impl Box32 {
    /// The corners in four lanes, the last one spare.
    pub(crate) fn corners(&self) -> Corners {
        let ([x0, y0, z0], [x1, y1, z1]) = (self.low, self.high);
        [[x0, y0, z0, 0.0], [x1, y1, z1, 0.0]]
    }

    /// The empty box.
    pub(crate) const EMPTY: Box32 = Box32 {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
    };

    /// The smallest box around both.
    #[inline]
    pub(crate) fn union(&self, other: &Box32) -> Box32 {
        // Written out: closures are not always inlined across codegen units.
        let ([a, b, c], [d, e, f]) = (self.low, other.low);
        let low = [smaller(a, d), smaller(b, e), smaller(c, f)];
        let ([a, b, c], [d, e, f]) = (self.high, other.high);
        let high = [larger(a, d), larger(b, e), larger(c, f)];
        Box32 { low, high }
    }

    /// Half the surface area.
    #[inline]
    pub(crate) fn half_area(&self) -> f32 {
        let [x, y, z] = self.extent();
        x * y + y * z + z * x
    }

    /// The lengths of the sides.
    #[inline]
    pub(crate) fn extent(&self) -> [f32; 3] {
        let ([a, b, c], [d, e, f]) = (self.low, self.high);
        [d - a, e - b, f - c]
    }

    /// Tests whether `other` lies within.
    pub(crate) fn contains(&self, other: &Box32) -> bool {
        (0..3).all(|k| self.low[k] <= other.low[k] && other.high[k] <= self.high[k])
    }
}
