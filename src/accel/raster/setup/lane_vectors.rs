//! Products of vectors in SIMD lanes.
//!
//! With `EXACT`, error bounds cover the result, so the compiler may use fused operations. Without
//! it, results are compared by their bits and must be the same at every SIMD level, so they are
//! never fused.

use crate::simd::{F32s, F64s, Lanes};

/// `a * b + c` in `f32`.
#[inline(always)]
pub(crate) fn multiply_add_f32<S: Lanes, const EXACT: bool>(a: S::F, b: S::F, c: S::F) -> S::F {
    if EXACT {
        a.fused_or_not(b, c)
    } else {
        a * b + c
    }
}

/// `a * b + c` in `f64`.
#[inline(always)]
pub(crate) fn multiply_add<S: Lanes, const EXACT: bool>(a: S::D, b: S::D, c: S::D) -> S::D {
    if EXACT {
        a.fused_or_not(b, c)
    } else {
        a * b + c
    }
}

#[inline(always)]
pub(crate) fn dot<S: Lanes, const EXACT: bool>(a: &[S::D; 3], b: &[S::D; 3]) -> S::D {
    let sum = multiply_add::<S, EXACT>(a[1], b[1], a[0] * b[0]);
    multiply_add::<S, EXACT>(a[2], b[2], sum)
}

/// The dot product with one vector for all lanes.
#[inline(always)]
pub(crate) fn row_times<S: Lanes, const EXACT: bool>(
    simd: S,
    row: &[f64; 3],
    v: &[S::D; 3],
) -> S::D {
    dot::<S, EXACT>(
        &[
            simd.splat_wide(row[0]),
            simd.splat_wide(row[1]),
            simd.splat_wide(row[2]),
        ],
        v,
    )
}

/// The dot product with one vector for all lanes, in `f32`.
#[inline(always)]
pub(crate) fn row_times_f32<S: Lanes, const EXACT: bool>(
    simd: S,
    row: &[f32; 3],
    v: &[S::F; 3],
) -> S::F {
    let sum = multiply_add_f32::<S, EXACT>(simd.splat(row[1]), v[1], simd.splat(row[0]) * v[0]);
    multiply_add_f32::<S, EXACT>(simd.splat(row[2]), v[2], sum)
}

#[inline(always)]
pub(crate) fn cross<S: Lanes, const EXACT: bool>(
    a: &[S::D; 3],
    b: &[S::D; 3],
    zero: S::D,
) -> [S::D; 3] {
    let mut product = *a;
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        // The second product is negated, so that the first may be fused.
        product[k] = multiply_add::<S, EXACT>(a[i], b[j], zero - a[j] * b[i]);
    }
    product
}
