//! Sorting keys by some of their bits, a digit at a time.

use rayon::prelude::*;
use std::slice::IterMut;

/// Bits of a digit: so many lines being written to fit into the caches.
const DIGIT_BITS: u32 = 10;
const DIGITS: usize = 1 << DIGIT_BITS;

/// Fewer keys than this are left to the standard library.
const SHORT: usize = 1 << 12;

/// Sorts `keys` by their bits from `low_bit` on; those that agree there keep their order.
pub(super) fn sort_from_bit(mut keys: Vec<u64>, low_bit: u32) -> Vec<u64> {
    if keys.len() < SHORT {
        keys.sort_by_key(|key| key >> low_bit);
        return keys;
    }
    let largest = keys.par_iter().copied().reduce(|| 0, u64::max);
    let mut moved = vec![0; keys.len()];
    let mut shift = low_bit;
    while shift < u64::BITS && largest >> shift > 0 {
        sort_by_digit(&keys, &mut moved, shift);
        std::mem::swap(&mut keys, &mut moved);
        shift += DIGIT_BITS;
    }
    keys
}

fn digit(key: u64, shift: u32) -> usize {
    (key >> shift) as usize % DIGITS
}

/// Writes `keys` to `sorted` in the order of a digit. Chunks are counted and moved in parallel: each has a place of its own
/// for every digit, behind that of the chunks before it.
fn sort_by_digit(keys: &[u64], sorted: &mut [u64], shift: u32) {
    let chunk = keys.len().div_ceil(4 * rayon::current_num_threads());
    let count = |keys: &[u64]| {
        let mut counts = [0u32; DIGITS];
        keys.iter().for_each(|key| counts[digit(*key, shift)] += 1);
        counts
    };
    let counts: Vec<[u32; DIGITS]> = keys.par_chunks(chunk).map(count).collect();
    let places = places(sorted, &counts);
    keys.par_chunks(chunk).zip(places).for_each(|(keys, mut places)| {
        for key in keys {
            *places[digit(*key, shift)].next().expect("as many places as keys were counted") = *key;
        }
    });
}

/// For each chunk the places of each digit.
fn places<'a>(mut sorted: &'a mut [u64], counts: &[[u32; DIGITS]]) -> Vec<Vec<IterMut<'a, u64>>> {
    let mut places: Vec<Vec<IterMut<u64>>> = counts.iter().map(|_| Vec::with_capacity(DIGITS)).collect();
    for digit in 0..DIGITS {
        for (places, counts) in places.iter_mut().zip(counts) {
            let (these, rest) = sorted.split_at_mut(counts[digit] as usize);
            places.push(these.iter_mut());
            sorted = rest;
        }
    }
    places
}
