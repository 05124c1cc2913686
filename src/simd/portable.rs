//! Lanes as plain arrays: for machines without a level of their own, and to compare the others with.

use super::{F32s, F64s, LANES, Lanes, Mask};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// No instructions that not every machine has.
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
    fn prefetch<T>(self, _what: &T) {}
}

/// One value for each lane, of an expression in its number.
macro_rules! each {
    ($lane:ident => $value:expr) => {{
        let mut all = [Default::default(); LANES];
        for $lane in 0..LANES {
            all[$lane] = $value;
        }
        all
    }};
}

macro_rules! operators {
    ($type:ident: $($operator:ident $method:ident $sign:tt),*) => {
        $(impl $operator for $type {
            type Output = $type;
            #[inline(always)]
            fn $method(self, other: $type) -> $type {
                $type(each!(k => self.0[k] $sign other.0[k]))
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
        M(each!(k => !self.0[k]))
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
        F(each!(k => if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] }))
    }
    #[inline(always)]
    fn max(self, other: F) -> F {
        F(each!(k => if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] }))
    }
    #[inline(always)]
    fn abs(self) -> F {
        F(each!(k => self.0[k].abs()))
    }
    #[inline(always)]
    fn floor(self) -> F {
        F(each!(k => self.0[k].floor()))
    }
    #[inline(always)]
    fn ceil(self) -> F {
        F(each!(k => self.0[k].ceil()))
    }
    #[inline(always)]
    fn fused_or_not(self, factor: F, addend: F) -> F {
        self * factor + addend
    }
    #[inline(always)]
    fn above(self, other: F) -> M {
        M(each!(k => self.0[k] > other.0[k]))
    }
    #[inline(always)]
    fn least(self) -> f32 {
        self.0.into_iter().fold(f32::INFINITY, f32::min)
    }
    #[inline(always)]
    fn widen(self) -> D {
        D(each!(k => f64::from(self.0[k])))
    }
    #[inline(always)]
    fn store_whole(self, to: &mut [i32; LANES]) {
        *to = each!(k => self.0[k] as i32);
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
        D(each!(k => self.0[k].sqrt()))
    }
    #[inline(always)]
    fn fused_or_not(self, factor: D, addend: D) -> D {
        self * factor + addend
    }
    #[inline(always)]
    fn narrow(self) -> F {
        F(each!(k => self.0[k] as f32))
    }
}

impl Mask for M {
    type F = F;

    #[inline(always)]
    fn bits(self) -> u32 {
        let mut bits = 0;
        for k in 0..LANES {
            bits |= u32::from(self.0[k]) << k;
        }
        bits
    }
    #[inline(always)]
    fn select(self, yes: F, no: F) -> F {
        F(each!(k => if self.0[k] { yes.0[k] } else { no.0[k] }))
    }
}
