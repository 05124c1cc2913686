//! SSE 4.1: sixteen `f32` fill four registers; a truth value sets all bits of its lane.

use super::level::level;
use crate::simd::lanes::{F32s, F64s, LANES, Lanes, Mask, SimdKernel, TABLE};
use crate::simd::unrolled::unrolled;
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

level!(Sse, "sse4.1", ["sse4.1"], 4 x 4, 8 wide, __m128, __m128d, __m128);

/// Operations on one register.
mod ops {
    use super::*;

    /// Defines functions of one or a few instructions each.
    macro_rules! instructions {
        ($($name:ident($($argument:ident: $type:ty),*) -> $result:ty = $value:expr;)*) => {
            $(#[inline]
            #[target_feature(enable = "sse4.1")]
            pub(super) fn $name($($argument: $type),*) -> $result {
                $value
            })*
        };
    }

    instructions! {
        splat(x: f32) -> __m128 = _mm_set1_ps(x);
        splat_wide(x: f64) -> __m128d = _mm_set1_pd(x);
        // SAFETY: the pointer is to four numbers.
        load(from: &[f32; 4]) -> __m128 = unsafe { _mm_loadu_ps(from.as_ptr()) };
        // SAFETY: the pointer is to two numbers.
        load_wide(from: &[f64; 2]) -> __m128d = unsafe { _mm_loadu_pd(from.as_ptr()) };
        pick_wide(table: &[f64; TABLE], places: &[u8; 2]) -> __m128d = {
            let [lower, upper] = places.map(|place| table[usize::from(place) % TABLE]);
            _mm_set_pd(upper, lower)
        };
        // SAFETY: the pointer is to four numbers.
        store(a: __m128, to: &mut [f32; 4]) -> () = unsafe { _mm_storeu_ps(to.as_mut_ptr(), a) };
        // SAFETY: the pointer is to two numbers.
        store_wide(a: __m128d, to: &mut [f64; 2]) -> () = unsafe {
            _mm_storeu_pd(to.as_mut_ptr(), a)
        };
        // SAFETY: the pointer is to four numbers.
        store_whole(a: __m128, to: &mut [i32; 4]) -> () = unsafe {
            _mm_storeu_si128(to.as_mut_ptr().cast(), _mm_cvttps_epi32(a))
        };
        add(a: __m128, b: __m128) -> __m128 = _mm_add_ps(a, b);
        sub(a: __m128, b: __m128) -> __m128 = _mm_sub_ps(a, b);
        mul(a: __m128, b: __m128) -> __m128 = _mm_mul_ps(a, b);
        div(a: __m128, b: __m128) -> __m128 = _mm_div_ps(a, b);
        min(a: __m128, b: __m128) -> __m128 = _mm_min_ps(a, b);
        max(a: __m128, b: __m128) -> __m128 = _mm_max_ps(a, b);
        abs(a: __m128) -> __m128 = _mm_andnot_ps(_mm_set1_ps(-0.0), a);
        floor(a: __m128) -> __m128 = _mm_floor_ps(a);
        ceil(a: __m128) -> __m128 = _mm_ceil_ps(a);
        fused_or_not(a: __m128, b: __m128, c: __m128) -> __m128 = _mm_add_ps(_mm_mul_ps(a, b), c);
        above(a: __m128, b: __m128) -> __m128 = _mm_cmpgt_ps(a, b);
        least(a: __m128) -> f32 = {
            let two = _mm_min_ps(a, _mm_movehl_ps(a, a));
            _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps::<1>(two, two)))
        };
        widen_lower(a: __m128) -> __m128d = _mm_cvtps_pd(a);
        widen_upper(a: __m128) -> __m128d = _mm_cvtps_pd(_mm_movehl_ps(a, a));
        add_wide(a: __m128d, b: __m128d) -> __m128d = _mm_add_pd(a, b);
        sub_wide(a: __m128d, b: __m128d) -> __m128d = _mm_sub_pd(a, b);
        mul_wide(a: __m128d, b: __m128d) -> __m128d = _mm_mul_pd(a, b);
        div_wide(a: __m128d, b: __m128d) -> __m128d = _mm_div_pd(a, b);
        sqrt_wide(a: __m128d) -> __m128d = _mm_sqrt_pd(a);
        fused_or_not_wide(a: __m128d, b: __m128d, c: __m128d) -> __m128d = {
            _mm_add_pd(_mm_mul_pd(a, b), c)
        };
        narrow(lower: __m128d, upper: __m128d) -> __m128 = {
            _mm_movelh_ps(_mm_cvtpd_ps(lower), _mm_cvtpd_ps(upper))
        };
        both(a: __m128, b: __m128) -> __m128 = _mm_and_ps(a, b);
        either(a: __m128, b: __m128) -> __m128 = _mm_or_ps(a, b);
        neither(a: __m128) -> __m128 = _mm_xor_ps(a, _mm_castsi128_ps(_mm_set1_epi32(-1)));
        bits(a: __m128) -> u32 = _mm_movemask_ps(a) as u32;
        select(mask: __m128, yes: __m128, no: __m128) -> __m128 = _mm_blendv_ps(no, yes, mask);
    }
}
