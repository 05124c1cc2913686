//! Finds blanks in text, and converts digits, by SSE2, which every x86-64 has.

use std::arch::x86_64::*;

/// See [`crate::simd::blanks`].
#[inline(always)]
pub(in crate::simd) fn blanks<const N: usize>(text: &[u8; N]) -> u64 {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { blanks_by_sse2(text) }
}

/// See [`crate::simd::four_numbers`].
#[inline(always)]
pub(in crate::simd) fn four_numbers(digits: [u64; 4]) -> Option<[u32; 4]> {
    // SAFETY: as above.
    unsafe { four_numbers_by_sse2(digits) }
}

#[inline]
#[target_feature(enable = "sse2")]
fn blanks_by_sse2<const N: usize>(text: &[u8; N]) -> u64 {
    let space = _mm_set1_epi8(b' ' as i8);
    let (parts, _) = text.as_chunks::<16>();
    let mut bits = 0;
    for (number, part) in parts.iter().enumerate() {
        // SAFETY: the pointer is to sixteen bytes.
        let bytes = unsafe { _mm_loadu_si128(part.as_ptr().cast()) };
        let is_blank = _mm_cmpeq_epi8(_mm_min_epu8(bytes, space), bytes);
        bits |= u64::from(_mm_movemask_epi8(is_blank) as u32) << (16 * number);
    }
    bits
}

#[inline]
#[target_feature(enable = "sse2")]
fn four_numbers_by_sse2(digits: [u64; 4]) -> Option<[u32; 4]> {
    let [a, b, c, d] = digits.map(u64::cast_signed);
    let (ab, cd) = (_mm_set_epi64x(b, a), _mm_set_epi64x(d, c));
    let greatest = _mm_max_epu8(ab, cd);
    let is_digit = _mm_cmpeq_epi8(_mm_min_epu8(greatest, _mm_set1_epi8(9)), greatest);
    if _mm_movemask_epi8(is_digit) != 0xffff {
        return None;
    }
    let fours = _mm_packs_epi32(fours(ab), fours(cd));
    let numbers = _mm_madd_epi16(fours, _mm_set1_epi32(1 << 16 | 10_000));
    let mut result = [0; 4];
    // SAFETY: the pointer is to sixteen bytes.
    unsafe { _mm_storeu_si128(result.as_mut_ptr().cast(), numbers) };
    Some(result)
}

/// The numbers that every four digits form.
#[inline]
#[target_feature(enable = "sse2")]
fn fours(digits: __m128i) -> __m128i {
    let tens = _mm_mullo_epi16(
        _mm_and_si128(digits, _mm_set1_epi16(0xff)),
        _mm_set1_epi16(10),
    );
    let pairs = _mm_add_epi16(tens, _mm_srli_epi16::<8>(digits));
    _mm_madd_epi16(pairs, _mm_set1_epi32(1 << 16 | 100))
}
