//! Four `f32` lanes, and boxes of them: one vector instruction for three axes.
//!
//! The compiler turns each operation into one instruction of the target's baseline. Boxes ignore
//! the last lane, so that their owner can use it.

use crate::accel::space::{Box32, larger, smaller};

/// A number for each axis, and a spare one.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub(super) struct F32x4(pub(super) [f32; 4]);

impl F32x4 {
    /// `x` in every lane.
    pub(super) const fn all(x: f32) -> F32x4 {
        F32x4([x; 4])
    }

    #[inline(always)]
    fn with(self, other: F32x4, f: impl Fn(f32, f32) -> f32) -> F32x4 {
        // Written out: an iterator with closures is not always inlined, and then not vectorized.
        let ([a, b, c, d], [e, g, h, i]) = (self.0, other.0);
        F32x4([f(a, e), f(b, g), f(c, h), f(d, i)])
    }

    /// The smaller in each lane; that of `other` if this one is NaN.
    #[inline(always)]
    pub(super) fn min(self, other: F32x4) -> F32x4 {
        self.with(other, smaller)
    }

    /// The larger in each lane; that of `other` if this one is NaN.
    #[inline(always)]
    pub(super) fn max(self, other: F32x4) -> F32x4 {
        self.with(other, larger)
    }

    #[inline(always)]
    pub(super) fn plus(self, other: F32x4) -> F32x4 {
        self.with(other, |a, b| a + b)
    }

    #[inline(always)]
    pub(super) fn minus(self, other: F32x4) -> F32x4 {
        self.with(other, |a, b| a - b)
    }

    #[inline(always)]
    pub(super) fn times(self, other: F32x4) -> F32x4 {
        self.with(other, |a, b| a * b)
    }

    /// The nearest integers of numbers from 0 to below 2^22, in the lowest 22 bits: adding 2^23
    /// shifts out all other bits. The result for other numbers is arbitrary.
    #[inline(always)]
    pub(super) fn rounded(self) -> [u32; 4] {
        let [a, b, c, d] = self.plus(F32x4::all((1 << 23) as f32)).0;
        [a.to_bits(), b.to_bits(), c.to_bits(), d.to_bits()]
    }

    /// The axis of the largest number; the lowest axis of equal ones.
    pub(super) fn widest_axis(self) -> usize {
        (1..3).fold(0, |widest, k| {
            if self.0[k] > self.0[widest] {
                k
            } else {
                widest
            }
        })
    }
}

/// A box in anchor space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LaneBox {
    pub(super) low: F32x4,
    pub(super) high: F32x4,
}

impl LaneBox {
    /// The empty box.
    pub(super) const EMPTY: LaneBox = LaneBox {
        low: F32x4::all(Box32::EMPTY.low[0]),
        high: F32x4::all(Box32::EMPTY.high[0]),
    };

    /// The smallest box around both.
    #[inline(always)]
    pub(super) fn union(self, other: LaneBox) -> LaneBox {
        LaneBox {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// The lengths of the sides.
    #[inline(always)]
    pub(super) fn extent(self) -> F32x4 {
        self.high.minus(self.low)
    }

    /// Half the surface area.
    #[inline(always)]
    pub(super) fn half_area(self) -> f32 {
        let [x, y, z, _] = self.extent().0;
        x * y + y * z + z * x
    }

    /// Drops the spare lanes.
    pub(super) fn to_box(self) -> Box32 {
        let ([x0, y0, z0, _], [x1, y1, z1, _]) = (self.low.0, self.high.0);
        Box32 {
            low: [x0, y0, z0],
            high: [x1, y1, z1],
        }
    }
}
