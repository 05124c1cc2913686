//! Lanes as plain arrays: for machines without another level, and as a baseline for tests.

use super::lanes::{F32s, F64s, LANES, Lanes, Mask, TABLE};
use super::unrolled::unrolled;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// The level that every machine has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Portable;

#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct F([f32; LANES]);

#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct D([f64; LANES]);

#[derive(Debug, Clone, Copy)]
pub(super) struct M([bool; LANES]);

impl Lanes for Portable {
    type F = F;
    type D = D;
    type M = M;

    #[inline(always)]
    fn splat(self, x: f32) -> F {
        F([x; LANES])
    }
    #[inline(always)]
    fn load(self, from: &[f32; LANES]) -> F {
        F(*from)
    }
    #[inline(always)]
    fn splat_wide(self, x: f64) -> D {
        D([x; LANES])
    }
    #[inline(always)]
    fn load_wide(self, from: &[f64; LANES]) -> D {
        D(*from)
    }
    #[inline(always)]
    fn pick_wide(self, table: &[f64; TABLE], places: &[u8; LANES]) -> D {
        D(unrolled!(16, K => table[usize::from(places[K]) % TABLE]))
    }
    #[inline(always)]
    fn prefetch<T>(self, _what: &T) {}
}

macro_rules! operators {
    ($type:ident: $($operator:ident $method:ident $sign:tt),*) => {
        $(impl $operator for $type {
            type Output = $type;
            #[inline(always)]
            fn $method(self, other: $type) -> $type {
                $type(unrolled!(16, K => self.0[K] $sign other.0[K]))
            }
        })*
    };
}

operators!(F: Add add +, Sub sub -, Mul mul *, Div div /);
operators!(D: Add add +, Sub sub -, Mul mul *, Div div /);
operators!(M: BitAnd bitand &, BitOr bitor |);

impl Not for M {
    type Output = M;
    #[inline(always)]
    fn not(self) -> M {
        M(unrolled!(16, K => !self.0[K]))
    }
}

impl F32s for F {
    type D = D;
    type M = M;

    #[inline(always)]
    fn store(self, to: &mut [f32; LANES]) {
        *to = self.0;
    }
    #[inline(always)]
    fn min(self, other: F) -> F {
        F(unrolled!(16, K => if self.0[K] < other.0[K] { self.0[K] } else { other.0[K] }))
    }
    #[inline(always)]
    fn max(self, other: F) -> F {
        F(unrolled!(16, K => if self.0[K] > other.0[K] { self.0[K] } else { other.0[K] }))
    }
    #[inline(always)]
    fn abs(self) -> F {
        F(unrolled!(16, K => self.0[K].abs()))
    }
    #[inline(always)]
    fn floor(self) -> F {
        F(unrolled!(16, K => self.0[K].floor()))
    }
    #[inline(always)]
    fn ceil(self) -> F {
        F(unrolled!(16, K => self.0[K].ceil()))
    }
    #[inline(always)]
    fn fused_or_not(self, factor: F, addend: F) -> F {
        self * factor + addend
    }
    #[inline(always)]
    fn above(self, other: F) -> M {
        M(unrolled!(16, K => self.0[K] > other.0[K]))
    }
    #[inline(always)]
    fn least(self) -> f32 {
        self.0.into_iter().fold(f32::INFINITY, f32::min)
    }
    #[inline(always)]
    fn widen(self) -> D {
        D(unrolled!(16, K => f64::from(self.0[K])))
    }
    #[inline(always)]
    fn store_whole(self, to: &mut [i32; LANES]) {
        *to = unrolled!(16, K => self.0[K] as i32);
    }
}

impl F64s for D {
    type F = F;

    #[inline(always)]
    fn store(self, to: &mut [f64; LANES]) {
        *to = self.0;
    }
    #[inline(always)]
    fn sqrt(self) -> D {
        D(unrolled!(16, K => self.0[K].sqrt()))
    }
    #[inline(always)]
    fn fused_or_not(self, factor: D, addend: D) -> D {
        self * factor + addend
    }
    #[inline(always)]
    fn narrow(self) -> F {
        F(unrolled!(16, K => self.0[K] as f32))
    }
}

impl Mask for M {
    type F = F;

    #[inline(always)]
    fn bits(self) -> u32 {
        let bits = unrolled!(16, K => u32::from(self.0[K]) << K);
        bits.into_iter().fold(0, |all, bit| all | bit)
    }
    #[inline(always)]
    fn select(self, yes: F, no: F) -> F {
        F(unrolled!(16, K => if self.0[K] { yes.0[K] } else { no.0[K] }))
    }
}
