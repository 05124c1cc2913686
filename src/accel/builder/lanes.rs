//! Four numbers at a time, and boxes of such lanes: what a build does most, in one instruction for three axes.
//!
//! Each operation is a loop over four lanes, which the compiler turns into one vector instruction of any target's
//! baseline. The last lane is free for whoever holds the box; boxes ignore it.

use crate::accel::space::{Box32, larger, smaller};

/// A number per axis, and one to spare.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub(super) struct Lanes(pub(super) [f32; 4]);

impl Lanes {
    /// `x` in every lane.
    pub(super) const fn all(x: f32) -> Lanes {
        Lanes([x; 4])
    }

    #[inline(always)]
    fn with(self, other: Lanes, f: impl Fn(f32, f32) -> f32) -> Lanes {
        // Written out: an iteration through closures is not inlined everywhere, and then is no vector instruction.
        let ([a, b, c, d], [e, g, h, i]) = (self.0, other.0);
        Lanes([f(a, e), f(b, g), f(c, h), f(d, i)])
    }

    /// The smaller in each lane; `other`'s where this one's is NaN.
    #[inline(always)]
    pub(super) fn min(self, other: Lanes) -> Lanes {
        self.with(other, smaller)
    }

    /// The larger in each lane; `other`'s where this one's is NaN.
    #[inline(always)]
    pub(super) fn max(self, other: Lanes) -> Lanes {
        self.with(other, larger)
    }

    #[inline(always)]
    pub(super) fn plus(self, other: Lanes) -> Lanes {
        self.with(other, |a, b| a + b)
    }

    #[inline(always)]
    pub(super) fn minus(self, other: Lanes) -> Lanes {
        self.with(other, |a, b| a - b)
    }

    #[inline(always)]
    pub(super) fn times(self, other: Lanes) -> Lanes {
        self.with(other, |a, b| a * b)
    }

    /// The nearest integers in the lowest 22 bits, of numbers from 0 to below 2^22: adding 2^23 pushes all other bits out.
    /// Anything where a number is none of these.
    #[inline(always)]
    pub(super) fn rounded(self) -> [u32; 4] {
        let [a, b, c, d] = self.plus(Lanes::all((1 << 23) as f32)).0;
        [a.to_bits(), b.to_bits(), c.to_bits(), d.to_bits()]
    }

    /// The axis of the largest number, the lowest of equal ones.
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

/// A box in anchor space, a corner in the lanes of each half.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LaneBox {
    pub(super) low: Lanes,
    pub(super) high: Lanes,
}

impl LaneBox {
    /// The box of nothing.
    pub(super) const EMPTY: LaneBox = LaneBox {
        low: Lanes::all(Box32::EMPTY.low[0]),
        high: Lanes::all(Box32::EMPTY.high[0]),
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
    pub(super) fn extent(self) -> Lanes {
        self.high.minus(self.low)
    }

    /// Half the surface area.
    #[inline(always)]
    pub(super) fn half_area(self) -> f32 {
        let [x, y, z, _] = self.extent().0;
        x * y + y * z + z * x
    }

    /// Without the spare lanes.
    pub(super) fn to_box(self) -> Box32 {
        let ([x0, y0, z0, _], [x1, y1, z1, _]) = (self.low.0, self.high.0);
        Box32 {
            low: [x0, y0, z0],
            high: [x1, y1, z1],
        }
    }
}
