//! A parallel, stable radix sort.

use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::slice::IterMut;

/// Bits of a digit. Each digit writes to its own cache line, and the caches hold 2^10 of them.
const DIGIT_BITS: u32 = 10;
const DIGITS: usize = 1 << DIGIT_BITS;

/// The standard library sorts shorter lists.
const SHORT: usize = 1 << 12;

/// Sorts `items` by their keys, which are below 2^`bits`; equal keys keep their order. `bits` must
/// not be 0.
pub(super) fn sort_by_digits<T: Copy + Send + Sync>(
    mut items: Vec<T>,
    bits: u32,
    key: impl Fn(T) -> u32 + Sync,
) -> Vec<T> {
    if items.len() < SHORT {
        items.sort_by_key(|item| key(*item));
        return items;
    }
    // Threads share the first touch of its memory.
    let mut sorted: Vec<T> = items.par_iter().copied().collect_vec();
    let digit_bits = bits.div_ceil(bits.div_ceil(DIGIT_BITS));
    for shift in (0..bits).step_by(digit_bits as usize) {
        sort_by_digit(&items, &mut sorted, |item| {
            (key(item) >> shift) as usize % (1 << digit_bits)
        });
        std::mem::swap(&mut items, &mut sorted);
    }
    items
}

/// Writes `items` to `sorted` in the order of a digit.
///
/// Chunks are counted and moved in parallel. Each has its own places for every digit, behind those
/// of earlier chunks, so the order does not depend on the number of chunks.
fn sort_by_digit<T: Copy + Send + Sync>(
    items: &[T],
    sorted: &mut [T],
    digit: impl Fn(T) -> usize + Sync,
) {
    let chunk = items.len().div_ceil(4 * rayon::current_num_threads());
    let count = |items: &[T]| {
        let mut counts = [0u32; DIGITS];
        items.iter().for_each(|item| counts[digit(*item)] += 1);
        counts
    };
    let counts: Vec<[u32; DIGITS]> = items.par_chunks(chunk).map(count).collect_vec();
    let places = places(sorted, &counts);
    items
        .par_chunks(chunk)
        .zip(places)
        .for_each(|(items, mut places)| {
            for item in items {
                *places[digit(*item)]
                    .next()
                    .expect("as many places as items were counted") = *item;
            }
        });
}

/// The places of each digit, for each chunk.
fn places<'a, T>(mut sorted: &'a mut [T], counts: &[[u32; DIGITS]]) -> Vec<Vec<IterMut<'a, T>>> {
    let mut places: Vec<Vec<IterMut<T>>> =
        counts.iter().map(|_| Vec::with_capacity(DIGITS)).collect();
    for digit in 0..DIGITS {
        for (places, counts) in places.iter_mut().zip(counts) {
            let (these, rest) = sorted.split_at_mut(counts[digit] as usize);
            places.push(these.iter_mut());
            sorted = rest;
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sorts_like_the_standard_library() {
        for len in [0, 1, SHORT - 1, SHORT, 50_000] {
            let item = |place: usize| {
                (
                    (place as u32).wrapping_mul(0x9e37_79b9) >> (12 + place % 9),
                    place,
                )
            };
            let items: Vec<(u32, usize)> = (0..len).map(item).collect();
            let mut expected = items.clone();
            expected.sort_by_key(|(key, _)| *key);
            assert!(
                sort_by_digits(items, 20, |(key, _)| key) == expected,
                "{len} items"
            );
        }
    }
}
