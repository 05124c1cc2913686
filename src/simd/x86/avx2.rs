//! AVX2 and FMA: sixteen `f32` fill two registers; a truth value sets all bits of its lane.

use super::level::level;
use crate::simd::lanes::{F32s, F64s, LANES, Lanes, Mask, SimdKernel, TABLE};
use crate::simd::unrolled::unrolled;
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

level!(Avx2, "avx2,fma,popcnt", ["avx2", "fma", "popcnt"], 2 x 8, 4 wide, __m256, __m256d, __m256);

/// Operations on one register.
mod ops {
    use super::*;

    /// Defines functions of one or a few instructions each.
    macro_rules! instructions {
        ($($name:ident($($argument:ident: $type:ty),*) -> $result:ty = $value:expr;)*) => {
            $(#[inline]
            #[target_feature(enable = "avx2,fma")]
            pub(super) fn $name($($argument: $type),*) -> $result {
                $value
            })*
        };
    }

    instructions! {
        splat(x: f32) -> __m256 = _mm256_set1_ps(x);
        splat_wide(x: f64) -> __m256d = _mm256_set1_pd(x);
        // SAFETY: the pointer is to eight numbers.
        load(from: &[f32; 8]) -> __m256 = unsafe { _mm256_loadu_ps(from.as_ptr()) };
        // SAFETY: the pointer is to four numbers.
        load_wide(from: &[f64; 4]) -> __m256d = unsafe { _mm256_loadu_pd(from.as_ptr()) };
        pick_wide(table: &[f64; TABLE], places: &[u8; 4]) -> __m256d = {
            let [a, b, c, d] = places.map(|place| table[usize::from(place) % TABLE]);
            _mm256_set_pd(d, c, b, a)
        };
        // SAFETY: the pointer is to eight numbers.
        store(a: __m256, to: &mut [f32; 8]) -> () = unsafe { _mm256_storeu_ps(to.as_mut_ptr(), a) };
        // SAFETY: the pointer is to four numbers.
        store_wide(a: __m256d, to: &mut [f64; 4]) -> () = unsafe {
            _mm256_storeu_pd(to.as_mut_ptr(), a)
        };
        // SAFETY: the pointer is to eight numbers.
        store_whole(a: __m256, to: &mut [i32; 8]) -> () = unsafe {
            _mm256_storeu_si256(to.as_mut_ptr().cast(), _mm256_cvttps_epi32(a))
        };
        add(a: __m256, b: __m256) -> __m256 = _mm256_add_ps(a, b);
        sub(a: __m256, b: __m256) -> __m256 = _mm256_sub_ps(a, b);
        mul(a: __m256, b: __m256) -> __m256 = _mm256_mul_ps(a, b);
        div(a: __m256, b: __m256) -> __m256 = _mm256_div_ps(a, b);
        min(a: __m256, b: __m256) -> __m256 = _mm256_min_ps(a, b);
        max(a: __m256, b: __m256) -> __m256 = _mm256_max_ps(a, b);
        abs(a: __m256) -> __m256 = _mm256_andnot_ps(_mm256_set1_ps(-0.0), a);
        floor(a: __m256) -> __m256 = _mm256_floor_ps(a);
        ceil(a: __m256) -> __m256 = _mm256_ceil_ps(a);
        fused_or_not(a: __m256, b: __m256, c: __m256) -> __m256 = _mm256_fmadd_ps(a, b, c);
        above(a: __m256, b: __m256) -> __m256 = _mm256_cmp_ps::<_CMP_GT_OQ>(a, b);
        least(a: __m256) -> f32 = {
            let four = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps::<1>(a));
            let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps::<1>(two, two)))
        };
        widen_lower(a: __m256) -> __m256d = _mm256_cvtps_pd(_mm256_castps256_ps128(a));
        widen_upper(a: __m256) -> __m256d = _mm256_cvtps_pd(_mm256_extractf128_ps::<1>(a));
        add_wide(a: __m256d, b: __m256d) -> __m256d = _mm256_add_pd(a, b);
        sub_wide(a: __m256d, b: __m256d) -> __m256d = _mm256_sub_pd(a, b);
        mul_wide(a: __m256d, b: __m256d) -> __m256d = _mm256_mul_pd(a, b);
        div_wide(a: __m256d, b: __m256d) -> __m256d = _mm256_div_pd(a, b);
        sqrt_wide(a: __m256d) -> __m256d = _mm256_sqrt_pd(a);
        fused_or_not_wide(a: __m256d, b: __m256d, c: __m256d) -> __m256d = _mm256_fmadd_pd(a, b, c);
        narrow(lower: __m256d, upper: __m256d) -> __m256 = _mm256_insertf128_ps::<1>(
            _mm256_castps128_ps256(_mm256_cvtpd_ps(lower)), _mm256_cvtpd_ps(upper)
        );
        both(a: __m256, b: __m256) -> __m256 = _mm256_and_ps(a, b);
        either(a: __m256, b: __m256) -> __m256 = _mm256_or_ps(a, b);
        neither(a: __m256) -> __m256 = _mm256_xor_ps(a, _mm256_castsi256_ps(_mm256_set1_epi32(-1)));
        bits(a: __m256) -> u32 = _mm256_movemask_ps(a) as u32;
        select(mask: __m256, yes: __m256, no: __m256) -> __m256 = _mm256_blendv_ps(no, yes, mask);
    }
}
