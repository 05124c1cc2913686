//! The operations on lanes that kernels can use, as traits.

use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// The number of lanes, the same at every level.
pub(crate) const LANES: usize = 16;

/// The number of entries of a table that lanes pick from.
pub(crate) const TABLE: usize = 32;

/// The instruction set of one level. A value proves that the machine has it.
pub(crate) trait Lanes: Copy + Debug {
    /// Sixteen `f32`.
    type F: F32s<D = Self::D, M = Self::M>;
    /// Sixteen `f64`.
    type D: F64s<F = Self::F>;
    /// Sixteen truth values.
    type M: Mask<F = Self::F>;

    fn splat(self, x: f32) -> Self::F;
    fn load(self, from: &[f32; LANES]) -> Self::F;
    fn splat_wide(self, x: f64) -> Self::D;
    fn load_wide(self, from: &[f64; LANES]) -> Self::D;
    /// The numbers of `table` at `places`, which are taken modulo [`TABLE`].
    fn pick_wide(self, table: &[f64; TABLE], places: &[u8; LANES]) -> Self::D;
    /// Prefetches a value that will soon be read, if the level can.
    fn prefetch<T>(self, what: &T);
}

/// Sixteen `f32`.
pub(crate) trait F32s:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    type D: F64s<F = Self>;
    type M: Mask<F = Self>;

    fn store(self, to: &mut [f32; LANES]);
    /// The smaller of the two; `other` if one is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger of the two; `other` if one is NaN.
    fn max(self, other: Self) -> Self;
    fn abs(self) -> Self;
    fn floor(self) -> Self;
    fn ceil(self) -> Self;
    /// `self * factor + addend`, rounded once or twice depending on the level.
    fn fused_or_not(self, factor: Self, addend: Self) -> Self;
    /// The lanes with `self > other`; false if one is NaN.
    fn above(self, other: Self) -> Self::M;
    /// The smallest lane. None may be NaN.
    fn least(self) -> f32;
    fn widen(self) -> Self::D;
    /// Stores the lanes as integers. They must be whole and fit.
    fn store_whole(self, to: &mut [i32; LANES]);
}

/// Sixteen `f64`.
pub(crate) trait F64s:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    type F: F32s<D = Self>;

    fn store(self, to: &mut [f64; LANES]);
    fn sqrt(self) -> Self;
    /// See [`F32s::fused_or_not`].
    fn fused_or_not(self, factor: Self, addend: Self) -> Self;
    /// The nearest `f32` to each.
    fn narrow(self) -> Self::F;
}

/// Sixteen truth values.
pub(crate) trait Mask:
    Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    type F;

    /// Lane k as bit k.
    fn bits(self) -> u32;
    /// Selects `yes` or `no`, lane by lane.
    fn select(self, yes: Self::F, no: Self::F) -> Self::F;
}

/// A computation that is compiled for each level.
pub(crate) trait SimdKernel {
    type Output;

    /// Must be `#[inline(always)]`.
    fn run<S: Lanes>(self, simd: S) -> Self::Output;
}
