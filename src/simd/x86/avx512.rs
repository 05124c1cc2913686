//! AVX-512: sixteen `f32` fill one register; truth values are bits of a mask.

use super::level::level;
use crate::simd::lanes::{F32s, F64s, LANES, Lanes, Mask, SimdKernel, TABLE};
use crate::simd::unrolled::unrolled;
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

level!(
    Avx512,
    "avx2,fma,popcnt,avx512f,avx512dq,avx512bw,avx512vl",
    ["avx2", "fma", "popcnt", "avx512f", "avx512dq", "avx512bw", "avx512vl"],
    1 x 16, 2 wide, __m512, __m512d, __mmask16
);

/// Operations on one register.
mod ops {
    use super::*;

    /// Defines functions of one or a few instructions each.
    macro_rules! instructions {
        ($($name:ident($($argument:ident: $type:ty),*) -> $result:ty = $value:expr;)*) => {
            $(#[inline]
            #[target_feature(enable = "avx2,fma,avx512f,avx512dq,avx512bw,avx512vl")]
            pub(super) fn $name($($argument: $type),*) -> $result {
                $value
            })*
        };
    }

    instructions! {
        splat(x: f32) -> __m512 = _mm512_set1_ps(x);
        splat_wide(x: f64) -> __m512d = _mm512_set1_pd(x);
        // SAFETY: the pointer is to sixteen numbers.
        load(from: &[f32; 16]) -> __m512 = unsafe { _mm512_loadu_ps(from.as_ptr()) };
        // SAFETY: the pointer is to eight numbers.
        load_wide(from: &[f64; 8]) -> __m512d = unsafe { _mm512_loadu_pd(from.as_ptr()) };
        pick_wide(table: &[f64; TABLE], places: &[u8; 8]) -> __m512d = {
            let (parts, _) = table.as_chunks::<8>();
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| load_wide(&parts[k]));
            let places = _mm512_cvtepu8_epi64(_mm_cvtsi64_si128(i64::from_le_bytes(*places)));
            let is_upper = _mm512_test_epi64_mask(places, _mm512_set1_epi64(16));
            let lower = _mm512_permutex2var_pd(a, places, b);
            _mm512_mask_blend_pd(is_upper, lower, _mm512_permutex2var_pd(c, places, d))
        };
        // SAFETY: the pointer is to sixteen numbers.
        store(a: __m512, to: &mut [f32; 16]) -> () = unsafe {
            _mm512_storeu_ps(to.as_mut_ptr(), a)
        };
        // SAFETY: the pointer is to eight numbers.
        store_wide(a: __m512d, to: &mut [f64; 8]) -> () = unsafe {
            _mm512_storeu_pd(to.as_mut_ptr(), a)
        };
        // SAFETY: the pointer is to sixteen numbers.
        store_whole(a: __m512, to: &mut [i32; 16]) -> () = unsafe {
            _mm512_storeu_si512(to.as_mut_ptr().cast(), _mm512_cvttps_epi32(a))
        };
        add(a: __m512, b: __m512) -> __m512 = _mm512_add_ps(a, b);
        sub(a: __m512, b: __m512) -> __m512 = _mm512_sub_ps(a, b);
        mul(a: __m512, b: __m512) -> __m512 = _mm512_mul_ps(a, b);
        div(a: __m512, b: __m512) -> __m512 = _mm512_div_ps(a, b);
        min(a: __m512, b: __m512) -> __m512 = _mm512_min_ps(a, b);
        max(a: __m512, b: __m512) -> __m512 = _mm512_max_ps(a, b);
        abs(a: __m512) -> __m512 = _mm512_abs_ps(a);
        floor(a: __m512) -> __m512 = {
            _mm512_roundscale_ps::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>(a)
        };
        ceil(a: __m512) -> __m512 = {
            _mm512_roundscale_ps::<{ _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC }>(a)
        };
        fused_or_not(a: __m512, b: __m512, c: __m512) -> __m512 = _mm512_fmadd_ps(a, b, c);
        above(a: __m512, b: __m512) -> __mmask16 = _mm512_cmp_ps_mask::<_CMP_GT_OQ>(a, b);
        least(a: __m512) -> f32 = _mm512_reduce_min_ps(a);
        widen_lower(a: __m512) -> __m512d = _mm512_cvtps_pd(_mm512_castps512_ps256(a));
        widen_upper(a: __m512) -> __m512d = _mm512_cvtps_pd(_mm512_extractf32x8_ps::<1>(a));
        add_wide(a: __m512d, b: __m512d) -> __m512d = _mm512_add_pd(a, b);
        sub_wide(a: __m512d, b: __m512d) -> __m512d = _mm512_sub_pd(a, b);
        mul_wide(a: __m512d, b: __m512d) -> __m512d = _mm512_mul_pd(a, b);
        div_wide(a: __m512d, b: __m512d) -> __m512d = _mm512_div_pd(a, b);
        sqrt_wide(a: __m512d) -> __m512d = _mm512_sqrt_pd(a);
        fused_or_not_wide(a: __m512d, b: __m512d, c: __m512d) -> __m512d = _mm512_fmadd_pd(a, b, c);
        narrow(lower: __m512d, upper: __m512d) -> __m512 = _mm512_insertf32x8::<1>(
            _mm512_castps256_ps512(_mm512_cvtpd_ps(lower)), _mm512_cvtpd_ps(upper)
        );
        both(a: __mmask16, b: __mmask16) -> __mmask16 = a & b;
        either(a: __mmask16, b: __mmask16) -> __mmask16 = a | b;
        neither(a: __mmask16) -> __mmask16 = !a;
        bits(a: __mmask16) -> u32 = u32::from(a);
        select(mask: __mmask16, yes: __m512, no: __m512) -> __m512 = {
            _mm512_mask_blend_ps(mask, no, yes)
        };
    }
}
